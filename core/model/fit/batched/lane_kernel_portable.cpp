#include "core/model/fit/batched/lane_kernels.hpp"

namespace loopscope::core::model {

const LaneKernel kPortableLanes = lane_kernel<ShortNumbers, NumberPair>("portable");

}  // namespace loopscope::core::model
