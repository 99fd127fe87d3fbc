#pragma once

#include <cstddef>
#include <vector>

#include "core/model/fit/fit.hpp"

namespace loopscope::core::model {

/// What a load of size one that moves at once leaves in the innovations, from its first sample on.
using LoadMark = std::vector<double>;

/// Of a load behind the process, by row of the grid.
[[nodiscard]] LoadMark output_load_mark(const NoiseModel& noise, const RowGrid& grid = {});
/// Of one before its lags, as the structure has them.
[[nodiscard]] LoadMark input_load_mark(const Structure& structure, const RowGrid& grid = {});

/// The few rows at which the innovations look most like the mark, apart from one another, the
/// likeliest first; none before `earliest_row`, nor while the noise model warms up.
[[nodiscard]] std::vector<std::size_t> places_of(const LoadMark& mark,
                                                 const std::vector<double>& innovations,
                                                 const RowGrid& grid = {},
                                                 std::size_t earliest_row = 0);

}  // namespace loopscope::core::model
