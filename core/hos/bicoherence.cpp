#include "core/hos/bicoherence.hpp"

#include <algorithm>

namespace loopscope::core::hos {

Bicoherence::Bicoherence(const Settings& settings)
    : spectra_(settings), domain_(settings.dft_length), bic2_(domain_.size()) {}

std::span<const double> Bicoherence::estimate(std::span<const double> signal) {
  spectra_.compute(signal);
  if (spectra_.segments() < 2) {
    return {};
  }
  return average();
}

std::span<const double> Bicoherence::scale_segments(std::span<const double> factors) {
  spectra_.scale_segments(factors);
  return average();
}

std::span<const double> Bicoherence::average() {
  sum_triples(spectra_, sums_);
  return normalise() ? std::span<const double>(bic2_) : std::span<const double>();
}

bool Bicoherence::normalise() {
  bool defined = false;
  std::size_t i = 0;
  for (std::size_t k2 = 1; k2 <= domain_.rows(); ++k2) {
    for (std::size_t k1 = k2; k1 < k2 + domain_.row_size(k2); ++k1, ++i) {
      const bool has_power = spectra_.total_power(k1) > 0.0 && spectra_.total_power(k2) > 0.0;
      const double denominator = has_power ? sums_.power12[i] * spectra_.total_power(k1 + k2) : 0.0;
      const double numerator =
          sums_.real[i] * sums_.real[i] + sums_.imaginary[i] * sums_.imaginary[i];
      // Rounding may lift a perfectly coupled triple a few units above 1.
      bic2_[i] = denominator > 0.0 ? std::min(1.0, numerator / denominator) : 0.0;
      defined = defined || denominator > 0.0;
    }
  }
  return defined;
}

}  // namespace loopscope::core::hos
