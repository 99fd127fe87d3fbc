#include "core/hos/bicoherence/bicoherence.hpp"

namespace loopscope::core::hos {

Bicoherence::Bicoherence(const Settings& settings, const Kernels& kernels)
    : spectra_(settings, kernels), domain_(settings.dft_length), bic2_(domain_.size()) {}

std::span<const double> Bicoherence::estimate(std::span<const double> signal) {
  transform(signal);
  return average();
}

std::span<const double> Bicoherence::average() {
  if (spectra_.segments() < 2) return {};
  sum_triples(spectra_, sums_);
  const TripleOutputs sums{sums_.real.data(), sums_.imaginary.data(), sums_.power12.data()};
  const bool defined = spectra_.kernels().normalise(sums, spectra_.total_power(),
                                                    spectra_.settings().dft_length, bic2_.data());
  return defined ? std::span<const double>(bic2_) : std::span<const double>();
}

}  // namespace loopscope::core::hos
