#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// Correlation of the spectra of segments d hops apart at one bin, for noise of a smooth spectrum
/// and but for the turn exp(-2 pi i k d hop / M): g_d(0) below, d = 0 .. the last hop at which
/// segments share a sample; the first is 1. `hop` >= 1.
[[nodiscard]] std::vector<double> segment_correlation(const std::vector<double>& window,
                                                      std::size_t hop);

/// What segments that share samples, and bins that share a main lobe, do to the null of the squared
/// bicoherence; all from the taper alone.
///
/// For a signal whose spectrum is smooth over a main lobe, with segments d hops apart,
///
///     <X_s(k) X*_{s+d}(k')> ~ g_d(k - k'),   g_d(D) = sum_t w(t) w(t - d hop) exp(-2 pi i D t / M)
///
/// divided by g_0(0). The triple product of bifrequencies (D1, D2) apart correlates by
/// G(D1, D2) = sum_d g_d(D1) g_d(D2) g_d*(D1 + D2), d from -lags to lags, and K bic2 is the squared
/// magnitude of a complex normal variable of that covariance.
class Overlap {
 public:
  /// Throws std::invalid_argument for settings out of range.
  explicit Overlap(const Settings& settings);

  /// The same, made at its first use and kept (plan_cache.hpp): it depends on few of the settings,
  /// and takes as long as a tenth of a bicoherence.
  [[nodiscard]] static const Overlap& of(const Settings& settings);

  /// Hops after which two segments no longer share a sample, less one.
  [[nodiscard]] std::size_t lags() const { return correlation_.size() - 1; }
  /// segment_correlation() of the settings: g_d(0) of d = 0 .. lags().
  [[nodiscard]] const std::vector<double>& correlation() const { return correlation_; }
  /// Mean of K bic2: G(0, 0); 1 for segments that share nothing. For the paper's, 1 + 2 g_1(0)^3 =
  /// 1.0111: neighbours correlate by 0.177 (1/6 and 1 + 2/216 in the limit of long segments).
  [[nodiscard]] double mean() const { return mean_; }
  /// Variance of the mean of K bic2 over many bifrequencies, times their number: the sum of
  /// |G(D1, D2)|^2 over all (D1, D2); 1 if bifrequencies were independent.
  [[nodiscard]] double correlated_cells() const { return correlated_cells_; }

 private:
  std::vector<double> correlation_;
  double mean_ = 1.0;
  double correlated_cells_ = 1.0;
};

}  // namespace loopscope::core::hos
