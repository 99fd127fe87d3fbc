#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/model/lagged_fit.hpp"

namespace loopscope::core::model {

/// A row is usable when three quarters of its samples are there, and counts when as many are in
/// `fit` too and every lag is usable. NaN = missing. `usable` of a sample: nonzero = its op is
/// known. All of equal length; samples beyond the last whole row are left out.
[[nodiscard]] LaggedRows lagged_rows(std::span<const double> pv, std::span<const std::uint8_t> fit,
                                     std::span<const std::uint8_t> op_known,
                                     std::size_t samples_per_row);

}  // namespace loopscope::core::model
