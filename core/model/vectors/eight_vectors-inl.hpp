// Compiled once for each kind of processor: number_pair.hpp.
#if defined(LOOPSCOPE_MODEL_EIGHT_VECTORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_MODEL_EIGHT_VECTORS_INL
#undef LOOPSCOPE_MODEL_EIGHT_VECTORS_INL
#else
#define LOOPSCOPE_MODEL_EIGHT_VECTORS_INL
#endif

#include <cstddef>
#include <cstring>
#include <hwy/highway.h>

#include "core/model/vectors/eight_numbers.hpp"
#include "core/model/vectors/number_pair.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model::HWY_NAMESPACE {

inline constexpr std::size_t kEightBytes = longest_vector_bytes(HWY_TARGET);
/// Of the compiler's own, side by side: kVectorsOfEight of them are EightNumbers.
using EightPart __attribute__((vector_size(kEightBytes))) = double;
inline constexpr std::size_t kVectorsOfEight = sizeof(EightNumbers) / kEightBytes;

[[nodiscard]] inline EightPart part_of(const EightNumbers& numbers, std::size_t part) {
  EightPart vector;
  std::memcpy(&vector, numbers.numbers + part * (kSideBySide / kVectorsOfEight), sizeof(vector));
  return vector;
}
inline void put_part(EightNumbers& numbers, std::size_t part, const EightPart& vector) {
  std::memcpy(numbers.numbers + part * (kSideBySide / kVectorsOfEight), &vector, sizeof(vector));
}

}  // namespace loopscope::core::model::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_MODEL_EIGHT_VECTORS_INL
