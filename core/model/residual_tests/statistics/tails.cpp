#include "core/model/residual_tests/statistics/tails.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace loopscope::core::model {
namespace {

/// std::lgamma leaves the sign in a variable that all threads share.
double log_gamma(double x) {
  int sign = 0;
  return ::lgamma_r(x, &sign);
}

/// As in core/hos: a p of 0 would call chance impossible and has no logarithm.
double as_probability(double p) {
  return std::clamp(p, std::numeric_limits<double>::min(), 1.0);
}

}  // namespace

double chi_square_upper(double value, std::size_t freedom) {
  if (!(value > 0.0)) return 1.0;
  // Q(a + 1, x) = Q(a, x) + x^a exp(-x) / Gamma(a + 1), from Q(1/2) or Q(1): positive terms only.
  const double x = 0.5 * value;
  double a = freedom % 2 == 1 ? 0.5 : 1.0;
  double upper = freedom % 2 == 1 ? std::erfc(std::sqrt(x)) : std::exp(-x);
  for (; a + 0.5 < 0.5 * static_cast<double>(freedom); a += 1.0)
    upper += std::exp(a * std::log(x) - x - log_gamma(a + 1.0));
  return as_probability(upper);
}

double bridge_upper(double value) {
  // Below 0.3 the probability differs from 1 by less than 1e-5, where the series converges slowly.
  if (!(value > 0.3)) return 1.0;
  double sum = 0.0;
  double sign = 1.0;
  for (int j = 1; j <= 20; ++j, sign = -sign) sum += sign * std::exp(-2.0 * j * j * value * value);
  return as_probability(2.0 * sum);
}

double largest_share_upper(double share, std::size_t count) {
  if (count < 2 || !(share > 0.0)) return 1.0;
  const auto n = static_cast<double>(count);
  return as_probability(n * std::pow(std::max(0.0, 1.0 - share), n - 1.0));
}

}  // namespace loopscope::core::model
