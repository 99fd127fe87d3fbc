#include "core/model/fit/batched/lane_foundations.hpp"

#if defined(__x86_64__)

// To the end of the file: templates belong to this processor where they are written, not where they
// are used.
#undef LOOPSCOPE_PATH
#define LOOPSCOPE_PATH avx2
#pragma GCC target("avx2")
#include "core/model/fit/batched/lane_kernels.hpp"

namespace loopscope::core::model {
namespace {

typedef float Singles __attribute__((vector_size(32)));
typedef double Doubles __attribute__((vector_size(32)));

}  // namespace

const LaneKernel kAvx2Lanes = lane_kernel<Singles, Doubles>("avx2");

}  // namespace loopscope::core::model

#endif
