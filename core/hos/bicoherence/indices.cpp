#include "core/hos/bicoherence/indices.hpp"

#include <cmath>

#include "core/hos/numeric/distributions.hpp"

namespace loopscope::core::hos {
double critical_mean_bic2(std::size_t segments, std::size_t bifrequencies, double alpha) {
  const auto k = static_cast<double>(segments);
  const auto l = static_cast<double>(bifrequencies);
  const double root = normal_upper_quantile(alpha) + std::sqrt(4.0 * l - 1.0);
  return root * root / (4.0 * k * l);
}

Indices indices(std::span<const double> bic2, std::size_t segments, double alpha,
                const Kernels& kernels) {
  const auto count = static_cast<double>(bic2.size());
  const ValueTotals values = kernels.sum_values(bic2);
  Indices result;
  result.mean_bic2 = values.sum / count;
  result.max_bic2 = values.largest;
  result.std_bic2 = std::sqrt(kernels.sum_square_deviations(bic2, result.mean_bic2) / count);
  result.critical_mean_bic2 = critical_mean_bic2(segments, bic2.size(), alpha);
  result.ngi = result.mean_bic2 - result.critical_mean_bic2;
  result.nli = std::abs(result.max_bic2 - (result.mean_bic2 + 2.0 * result.std_bic2));
  return result;
}

}  // namespace loopscope::core::hos
