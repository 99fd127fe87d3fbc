#include "core/hos/literature/bispectrum_direct.hpp"

#include <cstddef>

#include "core/hos/bicoherence/triple_sums.hpp"
#include "core/hos/transforms/spectra.hpp"

namespace loopscope::core::hos {

std::vector<std::complex<double>> bispectrum_direct(std::span<const double> signal,
                                                    const Settings& settings) {
  Spectra spectra(settings);
  spectra.compute(signal);
  if (spectra.segments() == 0) {
    return {};
  }
  double weight = 0.0;
  for (const double w : spectra.window()) {
    weight += w * w * w;
  }
  TripleSums sums;
  sum_triples(spectra, sums);
  const double average = 1.0 / (weight * static_cast<double>(spectra.segments()));
  const double scale = spectra.scale();
  std::vector<std::complex<double>> bispectrum(sums.real.size());
  for (std::size_t i = 0; i < bispectrum.size(); ++i) {
    bispectrum[i] = std::complex(sums.real[i], sums.imaginary[i]) * average * scale * scale * scale;
  }
  return bispectrum;
}

}  // namespace loopscope::core::hos
