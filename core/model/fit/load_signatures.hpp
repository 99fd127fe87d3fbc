#pragma once

#include <cstddef>
#include <vector>

#include "core/model/fit/fit.hpp"

namespace loopscope::core::model {

/// What a load of size one that moves at once leaves in the innovations, from its first sample on.
using LoadSignature = std::vector<double>;

/// Of a load behind the process, by row of the grid: 48 rows, behind a held sensor 12.
[[nodiscard]] LoadSignature output_load_signature(const NoiseModel& noise,
                                                  const RowGrid& grid = {});
/// Of one before its lags, as the structure has them: 96 rows, behind a held sensor 12.
[[nodiscard]] LoadSignature input_load_signature(const Structure& structure,
                                                 const RowGrid& grid = {});

/// The three rows at most at which the innovations look most like the mark, apart from one another,
/// the likeliest first; none before `earliest_row`, nor while the noise model warms up.
[[nodiscard]] std::vector<std::size_t> places_of(const LoadSignature& mark,
                                                 const std::vector<double>& innovations,
                                                 const RowGrid& grid = {},
                                                 std::size_t earliest_row = 0);

}  // namespace loopscope::core::model
