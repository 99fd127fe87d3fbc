#include "core/signal/order/sort_values.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace loopscope::core::signal {
namespace {

/// Fewer are sorted faster by comparisons (measured: the same at about 150).
constexpr std::size_t kFewestForRadix = 200;

constexpr std::size_t kDigits = 8;
constexpr std::size_t kRadix = 256;
constexpr std::uint64_t kSign = std::uint64_t{1} << 63;

using Keys = std::vector<std::uint64_t>;
using Counts = std::array<std::array<std::uint32_t, kRadix>, kDigits>;

/// Whole numbers in the order of the values: those below zero are turned around.
std::uint64_t key_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

double value_of(std::uint64_t key) {
  return std::bit_cast<double>((key & kSign) != 0 ? key & ~kSign : ~key);
}

std::size_t digit(std::uint64_t key, std::size_t place) {
  return static_cast<std::size_t>(key >> (8 * place)) & (kRadix - 1);
}

Counts count_digits(const Keys& keys) {
  Counts counts{};
  for (const std::uint64_t key : keys) {
    for (std::size_t place = 0; place < kDigits; ++place) ++counts[place][digit(key, place)];
  }
  return counts;
}

void sort_by_digit(const Keys& keys, std::size_t place,
                   const std::array<std::uint32_t, kRadix>& counts, Keys& sorted) {
  std::array<std::uint32_t, kRadix> next{};
  for (std::size_t d = 1; d < kRadix; ++d) next[d] = next[d - 1] + counts[d - 1];
  for (const std::uint64_t key : keys) sorted[next[digit(key, place)]++] = key;
}

}  // namespace

void sort_values(std::vector<double>& values) {
  if (values.size() < kFewestForRadix) {
    std::sort(values.begin(), values.end());
    return;
  }
  Keys keys(values.size());
  std::transform(values.begin(), values.end(), keys.begin(), key_of);
  Keys sorted(values.size());
  const Counts counts = count_digits(keys);
  for (std::size_t place = 0; place < kDigits; ++place) {
    // Where all have the same digit, as in exponents, there is nothing to do.
    if (counts[place][digit(keys.front(), place)] == keys.size()) continue;
    sort_by_digit(keys, place, counts[place], sorted);
    keys.swap(sorted);
  }
  std::transform(keys.begin(), keys.end(), values.begin(), value_of);
}

}  // namespace loopscope::core::signal
