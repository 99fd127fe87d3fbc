#pragma once

#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "core/hos/coupling/harmonic_filters.hpp"
#include "core/hos/kernels/kernels.hpp"

namespace loopscope::core::hos {

/// Phase coupling of an oscillation with its own harmonics, on segments that fit its period:
/// f + f -> 2f (a point on the diagonal of the bispectrum) and f + f + f -> 3f (of the
/// trispectrum). The second sees the odd-symmetric limit cycles (square, triangle: most of real
/// stiction) whose bispectrum is zero.
struct HarmonicStatistics {
  double period_samples = 0.0;  ///< of the fundamental
  /// -ln p, >= 0, against Gaussian noise around 2f and 3f (coherence_test.hpp).
  double quadratic_evidence = 0.0;
  double cubic_evidence = 0.0;
};

/// Coherence of the fundamental's amplitude squared (cubed) with the second (third) harmonic's,
/// over segments of 1.75 periods. Made once per period and used for many records.
class HarmonicTest {
 public:
  /// `period` in samples, at least kShortestPeriod of period.hpp.
  explicit HarmonicTest(double period);

  /// nullopt with fewer than four segments without a missing sample (NaN or infinity).
  [[nodiscard]] std::optional<HarmonicStatistics> measure(
      std::span<const double> signal, const Kernels& kernels = best_kernels()) const;

 private:
  double period_;
  HarmonicFilters filters_;
  std::vector<std::complex<double>> second_correlation_;  // of noise in the second harmonic
  std::vector<std::complex<double>> third_correlation_;
};

/// The same, once.
[[nodiscard]] std::optional<HarmonicStatistics> harmonic_statistics(
    std::span<const double> signal, double period, const Kernels& kernels = best_kernels());

}  // namespace loopscope::core::hos
