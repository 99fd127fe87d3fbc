#include "core/hos/cubic_test.hpp"

#include <complex>
#include <vector>

#include "core/hos/coherence_test.hpp"
#include "core/hos/harmonic_filters.hpp"
#include "core/hos/magnitude.hpp"
#include "core/hos/period.hpp"

namespace loopscope::core::hos {
namespace {

/// Segments below which the coherence has no freedom left.
constexpr std::size_t kFewestSegments = 4;

}  // namespace

std::optional<CubicStatistics> cubic_statistics(std::span<const double> signal, double period) {
  const HarmonicFilters filters(period);
  // Cubes of samples near the limits of double would overflow.
  const HarmonicFilters::Amplitudes amplitudes = filters.apply(scaled_to_unit(signal));
  if (amplitudes.positions.size() < kFewestSegments) return std::nullopt;
  std::vector<std::complex<double>> cubes = amplitudes.fundamental;
  for (std::complex<double>& value : cubes) value = value * value * value;
  return CubicStatistics{period, coherence_evidence({cubes, amplitudes.third, amplitudes.positions,
                                                     filters.noise_correlation()})};
}

std::optional<CubicStatistics> cubic_statistics(std::span<const double> signal) {
  const std::optional<double> period = dominant_period(signal);
  return period ? cubic_statistics(signal, *period) : std::nullopt;
}

}  // namespace loopscope::core::hos
