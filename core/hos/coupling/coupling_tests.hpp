#pragma once

#include <optional>

#include "core/hos/coupling/harmonic_test.hpp"
#include "core/hos/coupling/quadratic_test.hpp"
#include "core/hos/coupling/tested_spectra.hpp"

namespace loopscope::core::hos {

/// First-pass p of quadratic coupling somewhere: in one cell of the triangle, or of the oscillation
/// with its second harmonic on segments that fit it, which the triangle's short segments cannot
/// hold when it is slow.
[[nodiscard]] double nli_p(const QuadraticTest& test, const QuadraticStatistics& found,
                           const std::optional<HarmonicStatistics>& harmonics);

/// p-values of the three statistics of phase coupling against Gaussian noise of any spectrum:
/// closed forms (quadratic_test.hpp, harmonic_test.hpp). 1 = nothing found, or not testable.
struct CouplingTests {
  double mean_p = 1.0;            ///< of the mean squared bicoherence
  double nli_p = 1.0;             ///< largest cell, and f + f -> 2f
  std::optional<double> cubic_p;  ///< f + f + f -> 3f; nullopt = no period, or too few segments

  [[nodiscard]] double smallest() const;   ///< of the three p
  [[nodiscard]] double quadratic() const;  ///< the first two combined (combine_p.hpp)
  /// All combined, times 0.87: by so much the three tests stay below their nominal level.
  [[nodiscard]] double combined() const;
};

/// `harmonics` at the period of the record's strongest oscillation; nullptr where there is none.
[[nodiscard]] CouplingTests test_coupling(const TestedSpectra& tested,
                                          const HarmonicTest* harmonics);

}  // namespace loopscope::core::hos
