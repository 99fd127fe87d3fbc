#pragma once

#include "core/model/answer_batches.hpp"
#include "core/model/lagged_solution.hpp"
#include "core/model/lane_basis.hpp"
#include "core/model/tracker.hpp"

namespace loopscope::core::model {
inline namespace LOOPSCOPE_PATH {

/// A kernel in vectors of `Singles` and `Doubles`, the eight valves that are tracked at a time in
/// vectors of `Tracked`.
template <typename Singles, typename Doubles, typename Tracked>
constexpr LaneKernel lane_kernel(std::string_view name) {
  return {name, products_in<Singles>, products_in<Doubles>, tracked<Tracked>, fitted};
}

}  // namespace LOOPSCOPE_PATH
}  // namespace loopscope::core::model
