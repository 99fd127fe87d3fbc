#include "core/hos/numeric/distributions.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace loopscope::core::hos {
namespace {

namespace math = boost::math;

/// Half the time of the default, which counts in long double: a relative error of 1e-13 is enough.
/// What is no number goes through as such, and what underflows is 0: nobody catches an exception of
/// a p-value.
using Policy =
    math::policies::policy<math::policies::promote_double<false>,
                           math::policies::domain_error<math::policies::ignore_error>,
                           math::policies::overflow_error<math::policies::ignore_error>,
                           math::policies::evaluation_error<math::policies::ignore_error>>;

using Normal = math::normal_distribution<double, Policy>;
using FisherF = math::fisher_f_distribution<double, Policy>;
using StudentT = math::students_t_distribution<double, Policy>;
using Binomial = math::binomial_distribution<double, Policy>;

/// A tail that is smaller counts as this one where it becomes a deviate.
constexpr double kLeastTail = 1e-300;

}  // namespace

double above_zero(double p) {
  return std::max(p, std::numeric_limits<double>::min());
}

double normal_upper(double deviate) {
  return 0.5 * std::erfc(deviate / std::numbers::sqrt2);
}

double normal_upper_quantile(double probability) {
  return math::quantile(math::complement(Normal(), probability));
}

double chi_square_upper(double value, double freedom) {
  return gamma_upper(0.5 * value, 0.5 * freedom);
}

double gamma_upper(double value, double shape) {
  return value <= 0.0 ? 1.0 : math::gamma_q(shape, value, Policy());
}

double f_upper(double ratio, double freedom_1, double freedom_2) {
  return ratio <= 0.0 ? 1.0 : math::cdf(math::complement(FisherF(freedom_1, freedom_2), ratio));
}

double f_deviate(double ratio, double freedom_1, double freedom_2) {
  const double upper = f_upper(ratio, freedom_1, freedom_2);
  if (std::isnan(upper)) return upper;
  if (upper <= 0.5) return normal_upper_quantile(std::max(upper, kLeastTail));
  const double lower = ratio <= 0.0 ? 0.0 : math::cdf(FisherF(freedom_1, freedom_2), ratio);
  return -normal_upper_quantile(std::max(lower, kLeastTail));
}

double student_upper(double t, double freedom) {
  return math::cdf(math::complement(StudentT(freedom), t));
}

double binomial_at_least(std::size_t hits, std::size_t trials, double probability) {
  if (hits == 0) return 1.0;
  const Binomial law(static_cast<double>(trials), probability);
  return math::cdf(math::complement(law, static_cast<double>(hits) - 1.0));
}

}  // namespace loopscope::core::hos
