#pragma once

// Signals and valves go side by side in vectors as wide as the processor's. What does so stands in
// headers called *-inl.hpp, in a namespace of each kind of processor: an inline function of two
// kinds under one name would be one of them on every processor. Ordinary files include them as they
// are; kernels include them once for each kind, as Highway's foreach_target.h asks, hence
// their guards that are turned round instead of set. What they stand on is compiled once.
#include <cstddef>
#include <cstdint>
#include <hwy/detect_targets.h>
#include <type_traits>
#include <utility>

namespace loopscope::core::model {

/// Two numbers that every processor adds, compares and chooses (`condition ? a : b`) as one: what
/// compilers make of longer ones and of loops over lanes is slower than plain code.
using NumberPair __attribute__((vector_size(2 * sizeof(double)))) = double;

/// Four numbers of half the digits, in the same room as a pair: enough to rank guesses of a search.
using ShortNumbers __attribute__((vector_size(4 * sizeof(float)))) = float;

/// Bytes of the longest vectors that one kind of processor (HWY_TARGET of Highway) has, of those
/// that this room compiles for.
constexpr std::size_t longest_vector_bytes(std::int64_t target) {
  return target == HWY_AVX3 ? 64 : target == HWY_AVX2 ? 32 : sizeof(NumberPair);
}

/// What a Number is made of: NumberPair, ShortNumbers, or double, which is one by itself.
template <typename Number>
struct ElementOf {
  using type = std::remove_cvref_t<decltype(std::declval<Number&>()[0])>;
};
template <>
struct ElementOf<double> {
  using type = double;
};

template <typename Number>
inline constexpr std::size_t kElements = sizeof(Number) / sizeof(typename ElementOf<Number>::type);

/// One of the numbers side by side.
template <typename Number>
[[nodiscard]] typename ElementOf<Number>::type element(const Number& numbers, std::size_t at) {
  if constexpr (kElements<Number> == 1) {
    return numbers;
  } else {
    return numbers[at];
  }
}
template <typename Number>
void put_element(Number& numbers, std::size_t at, double value) {
  const auto few = static_cast<typename ElementOf<Number>::type>(value);
  if constexpr (kElements<Number> == 1) {
    numbers = few;
  } else {
    numbers[at] = few;
  }
}

/// What a comparison of Numbers gives.
template <typename Number>
using MaskOf = decltype(Number{} > Number{});

/// Some Numbers in a row. Not std::array: how a vector of more than 16 bytes is aligned depends on
/// what the code around it is compiled for, and here it stands written.
template <typename Number, std::size_t count>
struct alignas(sizeof(Number)) NumberRow {
  Number numbers[count];
  [[nodiscard]] Number& operator[](std::size_t i) { return numbers[i]; }
  [[nodiscard]] const Number& operator[](std::size_t i) const { return numbers[i]; }
  void fill(const Number& number) {
    for (Number& each : numbers) each = number;
  }
};

}  // namespace loopscope::core::model
