#include "core/hos/coupling/harmonic_test.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "core/hos/coupling/coherence_test.hpp"
#include "core/hos/numeric/magnitude.hpp"

namespace loopscope::core::hos {
namespace {

using Complex = std::complex<double>;

/// Segments below which the coherence has no freedom left.
constexpr std::size_t kFewestForCoherence = 4;

/// Of the signal over a power of two, since cubes of samples near the limits of double would
/// overflow. Sums of them do not, but for the last of those limits: the division can wait.
HarmonicFilters::Amplitudes amplitudes_of(std::span<const double> signal,
                                          const HarmonicFilters& filters, const Kernels& kernels) {
  constexpr double kFar = 0x1p900;
  const double scale = power_of_two_below(kernels.scan(signal).largest);
  if (scale > kFar || scale < 1.0 / kFar) return filters.apply(scaled_to_unit(signal), kernels);
  HarmonicFilters::Amplitudes amplitudes = filters.apply(signal, kernels);
  for (std::vector<Complex>& harmonic : amplitudes.harmonics) {
    for (Complex& value : harmonic) value /= scale;
  }
  return amplitudes;
}

/// Of the fundamental to the power `order` in the harmonic `order`: the smaller one of two tests.
/// Given the powers, where the harmonic's band is as loud in every segment; and given every
/// magnitude, where both bands get louder together, as bursts make them: then only the phases are
/// left to chance. Loudness that comes in the bands of the oscillation alone does not show in the
/// innovations.
double evidence_of(const HarmonicFilters::Amplitudes& amplitudes, std::size_t order,
                   std::span<const Complex> correlation) {
  const std::vector<Complex>& fundamental = amplitudes.harmonics[0];
  std::vector<Complex> powers = fundamental;
  for (std::size_t s = 0; s < powers.size(); ++s) {
    for (std::size_t i = 1; i < order; ++i) powers[s] *= fundamental[s];
  }
  std::vector<Complex> phases = amplitudes.harmonics[order - 1];
  const double given_powers =
      coherence_evidence({powers, phases, amplitudes.positions, correlation});
  for (std::size_t s = 0; s < powers.size(); ++s) {
    const double magnitude = std::sqrt(std::norm(phases[s]));
    powers[s] *= magnitude;
    phases[s] = magnitude > 0.0 ? phases[s] / magnitude : Complex(0.0);
  }
  return std::min(given_powers,
                  coherence_evidence({powers, phases, amplitudes.positions, correlation}));
}

}  // namespace

HarmonicTest::HarmonicTest(double period)
    : period_(period),
      filters_(period),
      second_correlation_(filters_.noise_correlation(2)),
      third_correlation_(filters_.noise_correlation(3)) {}

std::optional<HarmonicStatistics> HarmonicTest::measure(std::span<const double> signal,
                                                        const Kernels& kernels) const {
  const HarmonicFilters::Amplitudes amplitudes = amplitudes_of(signal, filters_, kernels);
  if (amplitudes.positions.size() < kFewestForCoherence) return std::nullopt;
  return HarmonicStatistics{period_, evidence_of(amplitudes, 2, second_correlation_),
                            evidence_of(amplitudes, 3, third_correlation_)};
}

std::optional<HarmonicStatistics> harmonic_statistics(std::span<const double> signal, double period,
                                                      const Kernels& kernels) {
  return HarmonicTest(period).measure(signal, kernels);
}

}  // namespace loopscope::core::hos
