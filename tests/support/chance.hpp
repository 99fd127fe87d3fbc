#pragma once
/// Bounds of rates, from the number of records that they are measured on.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

namespace loopscope::tests {

/// Four standard errors of a share of `records` records whose expectation is `rate`.
[[nodiscard]] double four_errors(double rate, std::integral auto records) {
  return 4.0 * std::sqrt(rate * (1.0 - rate) / static_cast<double>(records));
}

/// A bound on a mean of `full` records, widened as its standard error grows where there are fewer.
[[nodiscard]] double widened(double bound, std::integral auto full, std::integral auto records) {
  return bound * std::sqrt(std::max(1.0, static_cast<double>(full) / static_cast<double>(records)));
}

/// Of `records`, what a rate of bound / full shows at least in 999 of 1000 draws (and once: a break
/// shows none); the bound itself where there are as many as `full`.
[[nodiscard]] int at_least(double bound, std::integral auto full, std::integral auto records) {
  const double rate = bound / static_cast<double>(full);
  const double expected = rate * static_cast<double>(records);
  if (std::cmp_greater_equal(records, full)) return static_cast<int>(std::ceil(expected));
  return static_cast<int>(
      std::max(1.0, std::floor(expected - 3.0 * std::sqrt(expected * (1.0 - rate)))));
}

/// The same, at most.
[[nodiscard]] int at_most(double bound, std::integral auto full, std::integral auto records) {
  const double rate = bound / static_cast<double>(full);
  const double expected = rate * static_cast<double>(records);
  if (std::cmp_greater_equal(records, full)) return static_cast<int>(std::floor(expected));
  return static_cast<int>(std::floor(expected + 3.0 * std::sqrt(expected * (1.0 - rate))));
}

}  // namespace loopscope::tests
