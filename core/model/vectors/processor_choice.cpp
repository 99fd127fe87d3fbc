#include "core/model/vectors/processor_choice.hpp"

namespace loopscope::core::model {
namespace {

ProcessorKind find_out() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return ProcessorKind::avx512;
  if (__builtin_cpu_supports("avx2")) return ProcessorKind::avx2;
#endif
  return ProcessorKind::portable;
}

}  // namespace

ProcessorKind processor_kind() {
  static const ProcessorKind kind = find_out();
  return kind;
}

}  // namespace loopscope::core::model
