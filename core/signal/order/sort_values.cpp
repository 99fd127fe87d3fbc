#include "core/signal/order/sort_values.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "core/signal/order/bands.hpp"

namespace loopscope::core::signal {
namespace {

/// Fewer are sorted faster by comparisons (measured: the same at about 150).
constexpr std::size_t kFewestForRadix = 200;

/// A band holds a few values of a window; one that holds more takes longer than all digits do.
constexpr std::size_t kNarrowBands = 4096;
constexpr std::uint32_t kMostInBand = 24;

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

/// Fast where the keys are nearly in order.
void insert_in_order(Keys& keys) {
  for (std::size_t next = 1; next < keys.size(); ++next) {
    const std::uint64_t key = keys[next];
    std::size_t at = next;
    for (; at > 0 && keys[at - 1] > key; --at) keys[at] = keys[at - 1];
    keys[at] = key;
  }
}

/// Into bands, about as many as a window has values; what is left then is the order within them.
/// False = nothing was done: some band holds too many.
bool sort_by_bands(std::vector<double>& values) {
  const Bands bands(values, kNarrowBands);
  if (!bands.usable()) return false;
  std::array<std::uint32_t, kNarrowBands> next{};
  for (const double value : values) ++next[bands.of(value)];
  if (*std::ranges::max_element(next) > kMostInBand) return false;
  std::exclusive_scan(next.begin(), next.end(), next.begin(), std::uint32_t{0});
  Keys keys(values.size());
  for (const double value : values) keys[next[bands.of(value)]++] = key_of(value);
  insert_in_order(keys);
  std::ranges::transform(keys, values.begin(), value_of);
  return true;
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
  if (values.size() <= kMostInBand * kNarrowBands && sort_by_bands(values)) return;
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
