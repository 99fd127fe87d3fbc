#include "core/model/lane_kernels.hpp"

namespace loopscope::core::model {

const LaneKernel kPortableLanes = lane_kernel<ShortNumbers, NumberPair>("portable");

}  // namespace loopscope::core::model
