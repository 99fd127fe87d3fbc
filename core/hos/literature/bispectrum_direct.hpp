#pragma once

#include <complex>
#include <span>
#include <vector>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// Bispectrum by the direct method, eq. 1 with the expectation as an average over segments:
///
///     B(k1, k2) = <X(k1) X(k2) X*(k1+k2)> / sum w(n)^3
///
/// over PrincipalDomain(settings.dft_length), in its order; unit: that of the signal, cubed. The
/// divisor makes the level that of the process whatever the window: white noise has its third
/// central moment mu_3 everywhere, and a linear process mu_3 H(f1) H(f2) H*(f1+f2) (eq. 5).
/// Removing each segment's mean lowers bins within the window's main lobe of zero frequency.
///
/// NaN and infinity are missing samples; empty when no segment is complete. Throws
/// std::invalid_argument for settings out of range.
[[nodiscard]] std::vector<std::complex<double>> bispectrum_direct(std::span<const double> signal,
                                                                  const Settings& settings);

}  // namespace loopscope::core::hos
