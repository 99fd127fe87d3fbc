#pragma once

#include "core/model/vectors/lane_basis.hpp"

namespace loopscope::core::model {
inline namespace LOOPSCOPE_PATH {

template <std::size_t bytes>
struct LongsOf {
  using type __attribute__((vector_size(bytes))) = long long;
};

/// Copies of memory: what returns a vector has to belong to the kind of processor, and
/// std::bit_cast does not.
template <std::size_t bytes, typename Bits>
bool all_bits(const Bits& bits) {
  if constexpr (bytes == 2 * sizeof(long long)) {
    typename LongsOf<bytes>::type pair;
    std::memcpy(&pair, &bits, bytes);
    return (pair[0] & pair[1]) == -1;
  } else {
    std::array<typename LongsOf<bytes / 2>::type, 2> halves;
    std::memcpy(&halves, &bits, bytes);
    return all_bits<bytes / 2>(halves[0] & halves[1]);
  }
}

/// Whether the condition holds for each of the numbers side by side.
template <typename Mask>
bool holds_for_all(const Mask& mask) {
  if constexpr (std::is_same_v<Mask, bool>) {
    return mask;
  } else {
    return all_bits<sizeof(Mask)>(mask);
  }
}

}  // namespace LOOPSCOPE_PATH
}  // namespace loopscope::core::model
