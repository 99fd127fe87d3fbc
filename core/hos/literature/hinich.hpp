#pragma once

#include <cstddef>
#include <span>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// Settings under which the textbook null of bispectral tests holds: segments that share no sample
/// (no overlap) and bins that share no energy (no taper, no zero padding), so that squared
/// bicoherences of white Gaussian noise are independent but for what a shared frequency does.
///
/// Segments are the even number of samples next below sqrt(`samples`), 16 to 4096: Hinich (1982)
/// smooths over more than sqrt(N) triple products for a consistent bispectrum, and so many segments
/// are the same amount of smoothing. 64 for 4096 samples. All else as in Settings.
[[nodiscard]] Settings independent_segments(std::size_t samples);

/// The tests of Hinich, "Testing for Gaussianity and linearity of a stationary time series",
/// Journal of Time Series Analysis 3 (1982) 169-176.
///
/// Under Gaussianity the P values 2 K bic2 are chi-square variables with two degrees of freedom;
/// under linearity noncentral ones with one noncentrality lambda at every bifrequency.
struct HinichTest {
  double statistic = 0.0;      ///< S = sum of 2 K bic2 over the domain, >= 0
  double gaussianity_p = 1.0;  ///< P(chi-square with 2P degrees of freedom >= S)
  double lambda = 0.0;         ///< S / P - 2, or 0 where that is negative
  double iqr = 0.0;            ///< interquartile range of the values 2 K bic2
  double expected_iqr = 0.0;   ///< of the noncentral chi-square with that lambda
  double iqr_std = 0.0;        ///< asymptotic standard deviation of `iqr`, lambda taken as known
  /// Two-sided: lambda that differs between bifrequencies spreads the values, but coupling at a few
  /// of them raises the mean alone, which leaves the quartiles closer than lambda has them.
  double linearity_p = 1.0;
};

/// Both tests on the squared bicoherences `bic2` (P >= 4 of them, each 0 to 1) of `segments` (K >=
/// 2). Smoothing is over segments and not over squares of bifrequencies: then the estimate of this
/// room serves, and its normalisation (that of Kim and Powers) has the mean 2 exactly, also on the
/// diagonal k1 = k2, where Hinich's own needs a factor. The null asks for independent segments and
/// bifrequencies: estimate with independent_segments(), not with the paper's settings.
/// Throws std::invalid_argument for fewer values or segments.
[[nodiscard]] HinichTest hinich(std::span<const double> bic2, std::size_t segments);

}  // namespace loopscope::core::hos
