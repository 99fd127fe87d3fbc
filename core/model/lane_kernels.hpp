#pragma once

#include "core/model/answer_batches.hpp"
#include "core/model/lagged_solution.hpp"
#include "core/model/lane_basis.hpp"
#include "core/model/tracker.hpp"

namespace loopscope::core::model {
inline namespace LOOPSCOPE_PATH {

/// A kernel in vectors of `Singles` and `Doubles`; where there are no more than eight floats or
/// four doubles to go side by side, in vectors of `FewSingles` and `FewDoubles`.
template <typename Singles, typename Doubles, typename FewSingles, typename FewDoubles>
constexpr LaneKernel lane_kernel(std::string_view name) {
  return {name, products_in<Singles>, products_in<Doubles>, tracked<FewSingles>,
          fitted<FewDoubles>};
}

}  // namespace LOOPSCOPE_PATH
}  // namespace loopscope::core::model
