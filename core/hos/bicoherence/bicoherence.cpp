#include "core/hos/bicoherence/bicoherence.hpp"

#include <algorithm>

namespace loopscope::core::hos {

Bicoherence::Bicoherence(const Settings& settings, const Kernels& kernels)
    : spectra_(settings, kernels),
      domain_(settings.dft_length),
      has_power_(spectra_.frequencies()),
      bic2_(domain_.size()) {}

std::span<const double> Bicoherence::estimate(std::span<const double> signal) {
  transform(signal);
  return average();
}

std::span<const double> Bicoherence::average() {
  if (spectra_.segments() < 2) return {};
  sum_triples(spectra_, sums_);
  if (!find_denominators()) return {};
  normalise();
  return bic2_;
}

// Both loops are free of branches, so that the compiler makes vectors of them.
bool Bicoherence::find_denominators() {
  const double* const total = spectra_.total_power();
  for (std::size_t k = 0; k < has_power_.size(); ++k) has_power_[k] = total[k] > 0.0 ? 1.0 : 0.0;
  double largest = 0.0;
  double* denominator = sums_.power12.data();
  for (std::size_t k2 = 1; k2 <= domain_.rows(); ++k2) {
    const std::size_t count = domain_.row_size(k2);
    for (std::size_t i = 0; i < count; ++i) {
      const double power12 = denominator[i] * (has_power_[k2] * has_power_[k2 + i]);
      denominator[i] = power12 * total[2 * k2 + i];
      largest = std::max(largest, denominator[i]);
    }
    denominator += count;
  }
  return largest > 0.0;
}

void Bicoherence::normalise() {
  for (std::size_t i = 0; i < bic2_.size(); ++i) {
    const double re = sums_.real[i];
    const double im = sums_.imaginary[i];
    const double denominator = sums_.power12[i];
    const bool defined = denominator > 0.0;
    // Rounding may lift a perfectly coupled triple a few units above 1.
    const double value = std::min(1.0, (re * re + im * im) / (defined ? denominator : 1.0));
    bic2_[i] = defined ? value : 0.0;
  }
}

}  // namespace loopscope::core::hos
