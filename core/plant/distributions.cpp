#include "core/plant/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace loopscope::core::plant {
namespace {

constexpr std::size_t kFewestRanked = 8;
constexpr double kSmallest = 1e-300;

/// Continued fraction of the incomplete beta function (Lentz's method; Abramowitz and Stegun
/// 26.5.8), good for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  double c = 1.0;
  double d = 1.0 / std::max(kSmallest, 1.0 - (a + b) * x / (a + 1.0));
  double result = d;
  for (int m = 1; m < 500; ++m) {
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    for (const double term : {even, odd}) {
      d = 1.0 / (1.0 + term * d);
      c = 1.0 + term / c;
      result *= c * d;
    }
    if (std::abs(c * d - 1.0) < 1e-12) break;
  }
  return result;
}

/// Regularised incomplete beta function I_x(a, b).
double beta_share(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  if (x > (a + 1.0) / (a + b + 2.0)) return 1.0 - beta_share(b, a, 1.0 - x);
  const double log_front =
      std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
  return std::exp(log_front) / a * beta_fraction(a, b, x);
}

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double fisher_p(std::span<const double> p) {
  double s = 0.0;
  for (const double value : p) s -= std::log(std::max(value, kSmallest));
  double term = 1.0;
  double sum = 1.0;
  for (std::size_t k = 1; k < p.size(); ++k) sum += term *= s / static_cast<double>(k);
  return std::min(1.0, std::exp(-s) * sum);
}

double correlation_p(std::span<const double> x, std::span<const double> y) {
  if (x.size() < kFewestRanked) return 1.0;
  const double mx = mean_of(x), my = mean_of(y);
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mx) * (x[k] - mx);
    yy += (y[k] - my) * (y[k] - my);
    xy += (x[k] - mx) * (y[k] - my);
  }
  if (!(xx > 0.0 && yy > 0.0)) return 1.0;
  const double r = std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
  const double freedom = static_cast<double>(x.size()) - 4.0;
  const double two_sided = beta_share(freedom / 2.0, 0.5, 1.0 - r * r);
  return r > 0.0 ? two_sided / 2.0 : 1.0 - two_sided / 2.0;
}

double at_least_p(std::size_t hits, std::size_t trials, double p) {
  if (hits == 0) return 1.0;
  // Sum of the binomial tail = I_p(hits, trials - hits + 1).
  return beta_share(static_cast<double>(hits), static_cast<double>(trials - hits) + 1.0, p);
}

}  // namespace loopscope::core::plant
