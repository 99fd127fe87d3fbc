#include "core/hos/cubic_test.hpp"

#include <algorithm>
#include <complex>
#include <vector>

#include "core/hos/coherence_test.hpp"
#include "core/hos/harmonic_filters.hpp"
#include "core/hos/magnitude.hpp"

namespace loopscope::core::hos {
namespace {

/// Segments below which the coherence has no freedom left.
constexpr std::size_t kFewestSegments = 4;

void divide_by(const SegmentLevels& levels, const HarmonicFilters& filters,
               HarmonicFilters::Amplitudes& amplitudes) {
  for (std::size_t s = 0; s < amplitudes.positions.size(); ++s) {
    const double factor = levels.factor_at(filters.centre(amplitudes.positions[s]));
    amplitudes.fundamental[s] *= factor;
    amplitudes.third[s] *= factor;
  }
}

}  // namespace

std::optional<CubicStatistics> cubic_statistics(std::span<const double> signal, double period,
                                                const SegmentLevels* levels) {
  // Cubes of samples near the limits of double would overflow; a power of two is exact.
  const double scale = 1.0 / power_of_two_below(largest_magnitude(signal));
  std::vector<double> scaled(signal.size());
  std::transform(signal.begin(), signal.end(), scaled.begin(),
                 [scale](double value) { return value * scale; });
  const HarmonicFilters filters(period);
  HarmonicFilters::Amplitudes amplitudes = filters.apply(scaled);
  if (amplitudes.positions.size() < kFewestSegments) return std::nullopt;
  if (levels != nullptr) divide_by(*levels, filters, amplitudes);
  std::vector<std::complex<double>> cubes = amplitudes.fundamental;
  for (std::complex<double>& value : cubes) value = value * value * value;
  return CubicStatistics{period, coherence_evidence({cubes, amplitudes.third, amplitudes.positions,
                                                     filters.noise_correlation()})};
}

}  // namespace loopscope::core::hos
