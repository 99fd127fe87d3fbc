// Compiled once for each kind of processor: number_pair.hpp.
#if defined(LOOPSCOPE_MODEL_RECURSION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_MODEL_RECURSION_INL
#undef LOOPSCOPE_MODEL_RECURSION_INL
#else
#define LOOPSCOPE_MODEL_RECURSION_INL
#endif

#include <cstddef>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

/// y(k) = root y(k-1) + x(k), y(-1) = `before`. Number is double, or some of them: recursions
/// side by side. `read(k)` gives x(k) and is asked once for each k, in order, before `write(k, y)`.
///
/// Four samples at a time: each waits for the state four samples back only, so that the processor
/// is not idle for the time of a product and a sum at every sample.
template <typename Number, typename Read, typename Write>
inline void run_recursion(Number root, Number before, std::size_t count, Read read, Write write) {
  const Number root2 = root * root;
  const Number root3 = root2 * root;
  const Number root4 = root2 * root2;
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) {
    const Number a = read(k);
    const Number b = read(k + 1) + root * a;
    const Number c = read(k + 2) + root * b;
    const Number d = read(k + 3) + root * c;
    write(k, a + root * before);
    write(k + 1, b + root2 * before);
    write(k + 2, c + root3 * before);
    before = d + root4 * before;
    write(k + 3, before);
  }
  for (; k < count; ++k) {
    before = read(k) + root * before;
    write(k, before);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_MODEL_RECURSION_INL
