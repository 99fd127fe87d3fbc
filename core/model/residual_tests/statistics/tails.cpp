#include "core/model/residual_tests/statistics/tails.hpp"

#include <algorithm>
#include <cmath>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::model {
namespace {

double as_probability(double p) {
  return std::min(1.0, hos::above_zero(p));
}

}  // namespace

double chi_square_p(double value, std::size_t freedom) {
  return as_probability(hos::chi_square_upper(value, static_cast<double>(freedom)));
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
