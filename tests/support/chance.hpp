#pragma once
/// Bounds of rates, from the number of records that they are measured on.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
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

/// How much farther from what is expected a bound on a share lies that three standard errors of
/// `full` records have set, when there are `records`; 0 when there are as many.
[[nodiscard]] double three_errors_farther(double bound, std::integral auto full,
                                          std::integral auto records) {
  const double deviation = std::sqrt(bound * (1.0 - bound));
  return std::max(0.0, 3.0 * deviation *
                           (1.0 / std::sqrt(static_cast<double>(records)) -
                            1.0 / std::sqrt(static_cast<double>(full))));
}

/// Of `records` that each show with probability `rate` (below a half), so many that more show in at
/// most `chance` of all draws.
[[nodiscard]] inline std::size_t most(double rate, std::size_t records, double chance) {
  double exactly = std::pow(1.0 - rate, static_cast<double>(records));
  double so_far = exactly;
  std::size_t count = 0;
  for (; 1.0 - so_far > chance; ++count) {
    exactly *=
        rate / (1.0 - rate) * static_cast<double>(records - count) / static_cast<double>(count + 1);
    so_far += exactly;
  }
  return count;
}

/// The same, so few that fewer do; `rate` above a half.
[[nodiscard]] inline std::size_t fewest(double rate, std::size_t records, double chance) {
  return records - most(1.0 - rate, records, chance);
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
