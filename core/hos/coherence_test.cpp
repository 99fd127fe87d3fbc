#include "core/hos/coherence_test.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::hos {
namespace {

/// Sums over all ordered pairs of segments that share samples (and each with itself).
struct PairSums {
  double variance = 0.0;  // w^H R w
  double squares = 0.0;   // sum |R|^2
};

PairSums sum_pairs(const CoherencePair& pair) {
  PairSums sums;
  const std::size_t count = pair.products.size();
  for (std::size_t s = 0; s < count; ++s) {
    sums.variance += std::norm(pair.products[s]);
    sums.squares += 1.0;
    for (std::size_t t = s + 1; t < count; ++t) {
      const std::size_t lag = pair.positions[t] - pair.positions[s];
      if (lag >= pair.correlation.size()) break;
      const std::complex<double> r = pair.correlation[lag];
      sums.variance += 2.0 * (std::conj(pair.products[s]) * pair.products[t] * r).real();
      sums.squares += 2.0 * std::norm(r);
    }
  }
  return sums;
}

}  // namespace

double coherence_evidence(const CoherencePair& pair) {
  std::complex<double> numerator;
  double power = 0.0;
  double product_power = 0.0;
  for (std::size_t s = 0; s < pair.values.size(); ++s) {
    numerator += std::conj(pair.products[s]) * pair.values[s];
    power += std::norm(pair.values[s]);
    product_power += std::norm(pair.products[s]);
  }
  const PairSums sums = sum_pairs(pair);
  const auto count = static_cast<double>(pair.values.size());
  const double freedom = count * count / sums.squares;
  if (!(freedom > 1.0 && sums.variance > 0.0 && power > 0.0)) return 0.0;
  const double coherence = std::norm(numerator) / (product_power * power);
  const double ratio = coherence * count * product_power / (sums.variance * freedom);
  // Noise of few independent segments may lie closer to w than v and J allow on average; the
  // coherence itself, below 1 always, then holds the evidence back.
  const double held = ratio / (1.0 + std::max(0.0, ratio - coherence));
  // Rounding may lift a perfect coherence to 1.
  constexpr double kLargest = 1.0 - 1e-12;
  return -(freedom - 1.0) * std::log1p(-std::min(held, kLargest));
}

}  // namespace loopscope::core::hos
