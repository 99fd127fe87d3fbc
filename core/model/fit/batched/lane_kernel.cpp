#include "core/model/fit/batched/lane_kernel.hpp"

#include "core/model/vectors/processor_choice.hpp"

namespace loopscope::core::model {

const LaneKernel& best_lane_kernel() {
  return LOOPSCOPE_BEST_KERNEL(kPortableLanes, kAvx2Lanes, kAvx512Lanes);
}

}  // namespace loopscope::core::model
