#pragma once

namespace loopscope::core::model {

/// Kinds of processors that code is compiled for.
enum class ProcessorKind {
  portable,
  avx2,    ///< AVX2
  avx512,  ///< AVX-512 F, DQ, BW and VL: all but the Xeon Phi have them together
};

/// Of this processor; found out once.
[[nodiscard]] ProcessorKind processor_kind();

/// What was made for this processor of what was made for each.
#if defined(__x86_64__)
template <typename Kernel>
const Kernel& for_this_processor(const Kernel& portable, const Kernel& avx2, const Kernel& avx512) {
  switch (processor_kind()) {
    case ProcessorKind::avx512:
      return avx512;
    case ProcessorKind::avx2:
      return avx2;
    case ProcessorKind::portable:
      break;
  }
  return portable;
}
#define LOOPSCOPE_BEST_KERNEL(portable, avx2, avx512) for_this_processor(portable, avx2, avx512)
#else
#define LOOPSCOPE_BEST_KERNEL(portable, avx2, avx512) (portable)
#endif

}  // namespace loopscope::core::model
