#include "core/hos/coupling/coherence_test.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::hos {
namespace {

using Complex = std::complex<double>;

// Products are written out: those of std::complex look for NaN after each.

/// Adds a* b.
void add_product(Complex a, Complex b, Complex& sum) {
  sum +=
      Complex(a.real() * b.real() + a.imag() * b.imag(), a.real() * b.imag() - a.imag() * b.real());
}

/// Sums over all ordered pairs of segments that share samples (and each with itself).
struct PairTotals {
  double variance = 0.0;  // w^H R w
  double squares = 0.0;   // sum |R|^2
};

/// sum w*_s w_t over the pairs that are `lag` hops apart, and their number.
struct LaggedProducts {
  Complex sum;
  double pairs = 0.0;
};

/// Segments without a gap among them: the one `lag` hops on is `lag` places on.
LaggedProducts lagged_neighbours(const CoherencePair& pair, std::size_t lag) {
  const std::size_t count = pair.products.size();
  Complex even;
  Complex odd;
  std::size_t s = 0;
  for (; s + 1 + lag < count; s += 2) {
    add_product(pair.products[s], pair.products[s + lag], even);
    add_product(pair.products[s + 1], pair.products[s + 1 + lag], odd);
  }
  if (s + lag < count) add_product(pair.products[s], pair.products[s + lag], even);
  return {even + odd, count > lag ? static_cast<double>(count - lag) : 0.0};
}

LaggedProducts lagged_products(const CoherencePair& pair, std::size_t lag) {
  const std::size_t count = pair.products.size();
  if (count == 0) return {};
  if (pair.positions.back() - pair.positions.front() + 1 == count) {
    return lagged_neighbours(pair, lag);
  }
  LaggedProducts found;
  for (std::size_t s = 0; s < count; ++s) {
    // Positions increase, so that t is never more than `lag` places on.
    std::size_t t = std::min(s + lag, count - 1);
    while (pair.positions[t] > pair.positions[s] + lag) --t;
    if (pair.positions[t] != pair.positions[s] + lag) continue;
    add_product(pair.products[s], pair.products[t], found.sum);
    found.pairs += 1.0;
  }
  return found;
}

PairTotals total_of_pairs(const CoherencePair& pair, double product_power) {
  PairTotals totals{product_power, static_cast<double>(pair.products.size())};
  for (std::size_t lag = 1; lag < pair.correlation.size(); ++lag) {
    const Complex r = pair.correlation[lag];
    const LaggedProducts found = lagged_products(pair, lag);
    totals.variance += 2.0 * (found.sum.real() * r.real() - found.sum.imag() * r.imag());
    totals.squares += 2.0 * found.pairs * std::norm(r);
  }
  return totals;
}

}  // namespace

double coherence_evidence(const CoherencePair& pair) {
  Complex numerator;
  double power = 0.0;
  double product_power = 0.0;
  for (std::size_t s = 0; s < pair.values.size(); ++s) {
    add_product(pair.products[s], pair.values[s], numerator);
    power += std::norm(pair.values[s]);
    product_power += std::norm(pair.products[s]);
  }
  const PairTotals sums = total_of_pairs(pair, product_power);
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
