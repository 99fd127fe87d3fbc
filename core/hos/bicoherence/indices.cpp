#include "core/hos/bicoherence/indices.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::hos {
namespace {

/// Sum and maximum of f(value), eight at a time: one running sum would make every addition wait for
/// the one before it.
struct Totals {
  double sum = 0.0;
  double maximum = 0.0;
};

template <class Function>
Totals totals(std::span<const double> values, const Function& f) {
  std::array<double, 8> sums{};
  std::array<double, 8> maxima{};
  const std::size_t whole = values.size() / sums.size() * sums.size();
  for (std::size_t i = 0; i < whole; i += sums.size()) {
    for (std::size_t lane = 0; lane < sums.size(); ++lane) {
      const double value = f(values[i + lane]);
      sums[lane] += value;
      maxima[lane] = value > maxima[lane] ? value : maxima[lane];
    }
  }
  Totals result;
  for (std::size_t i = whole; i < values.size(); ++i) {
    result.sum += f(values[i]);
    result.maximum = std::max(result.maximum, f(values[i]));
  }
  for (std::size_t lane = 0; lane < sums.size(); ++lane) {
    result.sum += sums[lane];
    result.maximum = std::max(result.maximum, maxima[lane]);
  }
  return result;
}

}  // namespace

double critical_mean_bic2(std::size_t segments, std::size_t bifrequencies, double alpha) {
  const auto k = static_cast<double>(segments);
  const auto l = static_cast<double>(bifrequencies);
  const double root = normal_upper_quantile(alpha) + std::sqrt(4.0 * l - 1.0);
  return root * root / (4.0 * k * l);
}

Indices indices(std::span<const double> bic2, std::size_t segments, double alpha) {
  const auto count = static_cast<double>(bic2.size());
  const Totals values = totals(bic2, [](double value) { return value; });
  Indices result;
  result.mean_bic2 = values.sum / count;
  result.max_bic2 = values.maximum;
  const auto square = [mean = result.mean_bic2](double value) {
    return (value - mean) * (value - mean);
  };
  result.std_bic2 = std::sqrt(totals(bic2, square).sum / count);
  result.critical_mean_bic2 = critical_mean_bic2(segments, bic2.size(), alpha);
  result.ngi = result.mean_bic2 - result.critical_mean_bic2;
  result.nli = std::abs(result.max_bic2 - (result.mean_bic2 + 2.0 * result.std_bic2));
  return result;
}

}  // namespace loopscope::core::hos
