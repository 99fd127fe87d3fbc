#include "core/hos/harmonic_test.hpp"

#include <algorithm>
#include <complex>
#include <vector>

#include "core/hos/coherence_test.hpp"
#include "core/hos/harmonic_filters.hpp"
#include "core/hos/magnitude.hpp"

namespace loopscope::core::hos {
namespace {

using Complex = std::complex<double>;

/// Segments below which the coherence has no freedom left.
constexpr std::size_t kFewestSegments = 4;

void divide_by(const SegmentLevels& levels, const HarmonicFilters& filters,
               HarmonicFilters::Amplitudes& amplitudes) {
  for (std::size_t s = 0; s < amplitudes.positions.size(); ++s) {
    const double factor = levels.factor_at(filters.centre(amplitudes.positions[s]));
    for (std::vector<Complex>& harmonic : amplitudes.harmonics) harmonic[s] *= factor;
  }
}

/// Of the fundamental to the power `order` in the harmonic `order`.
double evidence_of(const HarmonicFilters& filters, const HarmonicFilters::Amplitudes& amplitudes,
                   std::size_t order) {
  std::vector<Complex> powers = amplitudes.harmonics[0];
  for (std::size_t s = 0; s < powers.size(); ++s) {
    for (std::size_t i = 1; i < order; ++i) powers[s] *= amplitudes.harmonics[0][s];
  }
  return coherence_evidence({powers, amplitudes.harmonics[order - 1], amplitudes.positions,
                             filters.noise_correlation(order)});
}

}  // namespace

std::optional<HarmonicStatistics> harmonic_statistics(std::span<const double> signal, double period,
                                                      const SegmentLevels* levels) {
  // Cubes of samples near the limits of double would overflow.
  const std::vector<double> scaled = scaled_to_unit(signal);
  const HarmonicFilters filters(period);
  HarmonicFilters::Amplitudes amplitudes = filters.apply(scaled);
  if (amplitudes.positions.size() < kFewestSegments) return std::nullopt;
  if (levels != nullptr) divide_by(*levels, filters, amplitudes);
  return HarmonicStatistics{period, evidence_of(filters, amplitudes, 2),
                            evidence_of(filters, amplitudes, 3)};
}

}  // namespace loopscope::core::hos
