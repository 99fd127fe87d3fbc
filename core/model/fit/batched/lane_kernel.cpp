#include "core/model/fit/batched/lane_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/model/fit/batched/lane_kernel.cpp"  // once for each processor
#include <hwy/foreach_target.h>
// The above includes this file again, so that what follows stands behind it.
#include <hwy/highway.h>

#include "core/model/fit/batched/response_batches-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

/// Of the compiler's own vectors, not of Highway's: those go into arrays and choose with ?:.
inline constexpr std::size_t kVectorBytes = longest_vector_bytes(HWY_TARGET);
using Singles __attribute__((vector_size(kVectorBytes))) = float;
using Doubles __attribute__((vector_size(kVectorBytes))) = double;

const LaneKernel* lane_kernel() {
  static const LaneKernel kernel{hwy::TargetName(HWY_TARGET), products_in<Singles>,
                                 products_in<Doubles>};
  return &kernel;
}

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace loopscope::core::model {

HWY_EXPORT(lane_kernel);

const LaneKernel& best_lane_kernel() {
  return *HWY_DYNAMIC_DISPATCH(lane_kernel)();
}

}  // namespace loopscope::core::model

#endif
