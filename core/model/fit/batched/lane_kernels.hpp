#pragma once

#include "core/model/fit/batched/lane_kernel.hpp"
#include "core/model/fit/batched/response_batches.hpp"
#include "core/model/vectors/lane_basis.hpp"

namespace loopscope::core::model {
inline namespace LOOPSCOPE_PATH {

/// A kernel in vectors of `Singles` and `Doubles`.
template <typename Singles, typename Doubles>
constexpr LaneKernel lane_kernel(std::string_view name) {
  return {name, products_in<Singles>, products_in<Doubles>};
}

}  // namespace LOOPSCOPE_PATH
}  // namespace loopscope::core::model
