#include "core/hos/kernels/kernels.hpp"

namespace loopscope::core::hos {
namespace {

std::vector<const Kernels*> find_runnable() {
  std::vector<const Kernels*> runnable = {&kPortableKernels};
#if defined(__x86_64__)
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (avx2) runnable.push_back(&kAvx2Kernels);
  if (__builtin_cpu_supports("avx512f")) runnable.push_back(&kAvx512Kernels);
#endif
  return runnable;
}

}  // namespace

const std::vector<const Kernels*>& runnable_kernels() {
  static const std::vector<const Kernels*> runnable = find_runnable();
  return runnable;
}

const Kernels& best_kernels() {
  return *runnable_kernels().back();
}

}  // namespace loopscope::core::hos
