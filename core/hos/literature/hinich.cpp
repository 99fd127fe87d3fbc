#include "core/hos/literature/hinich.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "core/hos/numeric/distributions.hpp"
#include "core/hos/numeric/quantile.hpp"

namespace loopscope::core::hos {
namespace {

constexpr double kLowerQuartile = 0.25;
constexpr double kUpperQuartile = 0.75;

std::vector<double> sorted_values(std::span<const double> bic2, std::size_t segments) {
  std::vector<double> values(bic2.begin(), bic2.end());
  for (double& value : values) {
    value *= 2.0 * static_cast<double>(segments);
  }
  std::ranges::sort(values);
  return values;
}

/// What the interquartile range of `count` values of one law tends to: its mean and, from the joint
/// asymptotic law of two sample quantiles, its standard deviation.
template <typename Law>
void set_expected_iqr(const Law& law, double count, HinichTest& test) {
  const double low = boost::math::quantile(law, kLowerQuartile);
  const double high = boost::math::quantile(law, kUpperQuartile);
  const double at_low = boost::math::pdf(law, low);
  const double at_high = boost::math::pdf(law, high);
  test.expected_iqr = high - low;
  test.iqr_std =
      std::sqrt((3.0 / (at_low * at_low) - 2.0 / (at_low * at_high) + 3.0 / (at_high * at_high)) /
                (16.0 * count));
}

void test_linearity(const std::vector<double>& values, HinichTest& test) {
  const auto count = static_cast<double>(values.size());
  test.lambda = std::max(0.0, test.statistic / count - 2.0);
  test.iqr = sample_quantile(values, kUpperQuartile) - sample_quantile(values, kLowerQuartile);
  if (test.lambda > 0.0) {
    set_expected_iqr(boost::math::non_central_chi_squared(2.0, test.lambda), count, test);
  } else {
    set_expected_iqr(boost::math::chi_squared(2.0), count, test);
  }
  const double deviate = std::abs(test.iqr - test.expected_iqr) / test.iqr_std;
  test.linearity_p = 2.0 * normal_upper(deviate);
}

}  // namespace

Settings independent_segments(std::size_t samples) {
  constexpr std::size_t kShortest = 16;
  constexpr std::size_t kLongest = 4096;
  const auto root = static_cast<std::size_t>(std::sqrt(static_cast<double>(samples)));
  Settings settings;
  settings.segment_length = std::clamp(root - root % 2, kShortest, kLongest);
  settings.dft_length = settings.segment_length;
  settings.overlap = 0.0;
  settings.window = WindowShape::rectangular;
  return settings;
}

HinichTest hinich(std::span<const double> bic2, std::size_t segments) {
  if (bic2.size() < 4 || segments < 2) {
    throw std::invalid_argument("Hinich's tests: at least 4 bifrequencies and 2 segments");
  }
  const std::vector<double> values = sorted_values(bic2, segments);
  HinichTest test;
  test.statistic = std::accumulate(values.begin(), values.end(), 0.0);
  const boost::math::chi_squared gaussian(2.0 * static_cast<double>(values.size()));
  test.gaussianity_p = boost::math::cdf(boost::math::complement(gaussian, test.statistic));
  test_linearity(values, test);
  return test;
}

}  // namespace loopscope::core::hos
