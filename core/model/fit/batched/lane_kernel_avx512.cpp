#include "core/model/fit/batched/lane_foundations.hpp"

#if defined(__x86_64__)

// To the end of the file: templates belong to this processor where they are written, not where they
// are used.
#undef LOOPSCOPE_PATH
#define LOOPSCOPE_PATH avx512
#pragma GCC target("avx512f,avx512dq,avx512bw,avx512vl")
#include "core/model/fit/batched/lane_kernels.hpp"

namespace loopscope::core::model {
namespace {

typedef float Singles __attribute__((vector_size(64)));
typedef double Doubles __attribute__((vector_size(64)));

}  // namespace

const LaneKernel kAvx512Lanes = lane_kernel<Singles, Doubles>("avx512");

}  // namespace loopscope::core::model

#endif
