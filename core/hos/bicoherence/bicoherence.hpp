#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/hos/bicoherence/triple_sums.hpp"
#include "core/hos/kernels/principal_domain.hpp"
#include "core/hos/transforms/settings.hpp"
#include "core/hos/transforms/spectra.hpp"

namespace loopscope::core::hos {

/// Squared bicoherence, eq. 2 and 6 read as Kim and Powers (1979) normalise it:
///
///     bic2(k1, k2) = |<X(k1) X(k2) X*(k1+k2)>|^2 / (<|X(k1) X(k2)|^2> <|X(k1+k2)|^2>)
///
/// with averages <> over segments. By the Cauchy-Schwarz inequality it lies within 0 to 1.
/// Other normalisations travel under the same name; this one alone has the null that eq. 9 uses.
///
/// Made once per settings, then used for many signals (surrogates) in the same
/// buffers; one object per thread. No estimate after the first of a length allocates.
class Bicoherence {
 public:
  /// Throws std::invalid_argument for settings out of range.
  explicit Bicoherence(const Settings& settings, const Kernels& kernels = best_kernels());

  /// Squared bicoherence over domain(), valid until the next call; NaN and infinity are missing
  /// samples. A bifrequency whose denominator is no more than rounding noise has 0. Empty when
  /// fewer than two segments are complete (bic2 of one segment is 1 whatever the signal) or all
  /// denominators are zero, as for a constant.
  std::span<const double> estimate(std::span<const double> signal);

  /// The same in steps: the spectra of a signal's segments; then, any number of times, every
  /// segment's multiplied by its factor (> 0, segments() of them); then the estimate.
  void transform(std::span<const double> signal) { spectra_.compute(signal); }
  void scale_segments(std::span<const double> factors) { spectra_.scale_segments(factors); }
  std::span<const double> average();

  /// K of the last estimate.
  [[nodiscard]] std::size_t segments() const { return spectra_.segments(); }
  /// The spectra behind the last estimate.
  [[nodiscard]] const Spectra& spectra() const { return spectra_; }
  [[nodiscard]] const PrincipalDomain& domain() const { return domain_; }

 private:
  Spectra spectra_;
  PrincipalDomain domain_;
  TripleSums sums_;
  std::vector<double> bic2_;
};

}  // namespace loopscope::core::hos
