#pragma once

#include <optional>
#include <span>

namespace loopscope::core::loop {

/// Standard error of the natural logarithm of the variance of `error` (samples at one interval, NaN
/// = missing), as an estimate of the variance that the loop would show in the long run.
///
/// The variance is the mean of x = (e - mean e)^2, whose own error follows from x's autocorrelation
/// rho: var(mean x) = var(x) 2 tau / n with tau = 1/2 + rho(1) + rho(2) + ... over the recorded n.
/// No law of e is assumed, so limit cycles (whose variance is known well) and rare large moves
/// (whose variance is not) count for what they are; for Gaussian e it is Bartlett's sum of squared
/// correlations. The sum ends by itself (Sokal 1997, section 3). nullopt when the error does not
/// vary or too few pairs of samples are recorded; 0 when its square does not vary (square wave).
[[nodiscard]] std::optional<double> log_variance_error(std::span<const double> error);

}  // namespace loopscope::core::loop
