#include "core/hos/literature/fackrell.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <stdexcept>

namespace loopscope::core::hos {
namespace {

double chance_of_so_many(std::size_t exceeding, std::size_t bifrequencies, double alpha) {
  if (exceeding == 0) {
    return 1.0;
  }
  const boost::math::binomial chance(static_cast<double>(bifrequencies), alpha);
  return boost::math::cdf(boost::math::complement(chance, static_cast<double>(exceeding) - 1.0));
}

}  // namespace

FackrellTest fackrell(std::span<const double> bic2, std::size_t segments, double alpha) {
  if (bic2.empty() || segments < 2 || !(alpha > 0.0 && alpha < 1.0)) {
    throw std::invalid_argument("Fackrell's test: too little data, or alpha not within 0 to 1");
  }
  // A chi-square variable with two degrees of freedom passes q with probability exp(-q / 2).
  const auto k = static_cast<double>(segments);
  const double limit = -std::log(alpha) / k;
  FackrellTest test;
  test.exceeding = static_cast<std::size_t>(
      std::ranges::count_if(bic2, [limit](double value) { return value > limit; }));
  test.expected = alpha * static_cast<double>(bic2.size());
  test.smallest_p = std::exp(-k * *std::ranges::max_element(bic2));
  test.count_p = chance_of_so_many(test.exceeding, bic2.size(), alpha);
  return test;
}

}  // namespace loopscope::core::hos
