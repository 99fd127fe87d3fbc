#include "core/hos/coupling/null_laws.hpp"

#include <algorithm>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::hos {
namespace {

/// Skewness of the mean in units of its relative standard deviation, measured; a sum of squared
/// normal deviates, which a gamma distribution describes, would have 2.
constexpr double kRelativeSkewness = 2.9;

}  // namespace

double p_of_evidence(double evidence) {
  return above_zero(std::exp(-evidence));
}

double mean_law_upper(double value, double mean, double std) {
  const double skewness = kRelativeSkewness * std / mean;
  const double shape = 4.0 / (skewness * skewness);
  const double scale = std * skewness / 2.0;
  const double position = value - (mean - shape * scale);
  if (!(position > 0.0)) return 1.0;
  return above_zero(boost::math::cdf(
      boost::math::complement(boost::math::gamma_distribution<>(shape, scale), position)));
}

double cell_law_upper(double evidence, double level) {
  // Beyond this the noncentral series only loses digits; the bound exp(-(b - a)^2 / 2) of the Rice
  // distribution is as good there.
  constexpr double kFar = 300.0;
  // Boost 1.74 has 0 here for the complement of a distribution function of 0.
  if (!(evidence > 0.0)) return 1.0;
  if (level <= 0.0) return p_of_evidence(evidence);
  if (evidence > kFar) {
    const double distance = std::sqrt(evidence) - std::sqrt(level);
    return distance > 0.0 ? p_of_evidence(distance * distance) : 1.0;
  }
  const boost::math::non_central_chi_squared_distribution<> law(2.0, 2.0 * level);
  return above_zero(boost::math::cdf(boost::math::complement(law, 2.0 * evidence)));
}

double smallest_of(double p, double cells) {
  constexpr double kLargest = 1.0 - 1e-12;
  return -std::expm1(cells * std::log1p(-std::min(p, kLargest)));
}

}  // namespace loopscope::core::hos
