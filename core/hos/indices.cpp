#include "core/hos/indices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/hos/normal_quantile.hpp"

namespace loopscope::core::hos {

double critical_mean_bic2(std::size_t segments, std::size_t bifrequencies, double alpha) {
  const auto k = static_cast<double>(segments);
  const auto l = static_cast<double>(bifrequencies);
  const double root = upper_normal_quantile(alpha) + std::sqrt(4.0 * l - 1.0);
  return root * root / (4.0 * k * l);
}

Indices indices(std::span<const double> bic2, std::size_t segments, double alpha) {
  const auto count = static_cast<double>(bic2.size());
  Indices result;
  result.mean_bic2 = std::accumulate(bic2.begin(), bic2.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : bic2) {
    squares += (value - result.mean_bic2) * (value - result.mean_bic2);
  }
  result.std_bic2 = std::sqrt(squares / count);
  result.max_bic2 = *std::max_element(bic2.begin(), bic2.end());
  result.critical_mean_bic2 = critical_mean_bic2(segments, bic2.size(), alpha);
  result.ngi = result.mean_bic2 - result.critical_mean_bic2;
  result.nli = std::abs(result.max_bic2 - (result.mean_bic2 + 2.0 * result.std_bic2));
  return result;
}

}  // namespace loopscope::core::hos
