#pragma once

#include <complex>
#include <span>
#include <vector>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos::tests {

/// y(k) = sum taps(n) x(k - n), without the start where not all x are known.
[[nodiscard]] std::vector<double> moving_average(std::span<const double> x,
                                                 std::span<const double> taps);

/// Expects mu_3 H(f1) H(f2) H*(f1+f2) (eq. 5), mu_3 = 2 as exponential_noise has it, within
/// `tolerance` of the largest magnitude over the domain, wherever no frequency lies within the
/// main lobe of zero frequency, where removed means take power away.
void expect_near_linear(std::span<const std::complex<double>> bispectrum,
                        const std::vector<double>& taps, const Settings& settings,
                        double tolerance);

}  // namespace loopscope::core::hos::tests
