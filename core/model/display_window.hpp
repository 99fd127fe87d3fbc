#pragma once

#include <cstddef>
#include <span>

#include "core/model/record/loop_data.hpp"

namespace loopscope::core::model {

/// A stretch of samples in which a picture shows what an effect does: about six cycles of op, 200
/// to 600 samples, `fewest` at least, and never longer than the record. `gain`: by sample, what the
/// effect takes off the squared error; NaN counts as none. The stretch lies about the place at
/// which the gain, weighed by a triangle of the stretch's length, is largest, or in the middle of
/// the record where it is nowhere above 0. op: NaN = missing, not constant; as long as `gain`.
[[nodiscard]] Range telling_stretch(std::span<const double> op, std::span<const double> gain,
                                    std::size_t fewest);

}  // namespace loopscope::core::model
