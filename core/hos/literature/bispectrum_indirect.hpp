#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// Lag window of the indirect method: Parzen's, 1 at lag 0, 0 at max_lag (> 0) and beyond. Its
/// spectrum is nowhere negative, so that a strong line cannot leak with the wrong sign.
[[nodiscard]] double parzen(std::ptrdiff_t lag, std::size_t max_lag);

/// Bispectrum by the indirect method, eq. 1 read as the double DFT of the windowed cumulant:
///
///     B(k1, k2) = sum c3(t1, t2) d(t1) d(t2) d(t1 - t2) exp(-2 pi i (k1 t1 + k2 t2) / M)
///
/// with d = parzen up to lags of half a segment (Nikias and Petropulu 1993 for the product form).
/// Same domain, order and unit as bispectrum_direct; segments, overlap and taper play no part.
/// Cost: samples x segment_length^2 / 8 triple products, some twenty times the direct method's with
/// the paper's settings. It makes use of every sample beside a gap and has no segment to taper, so
/// it checks the direct method independently.
///
/// NaN and infinity are missing samples; empty when no sample is finite. Throws
/// std::invalid_argument for settings out of range.
[[nodiscard]] std::vector<std::complex<double>> bispectrum_indirect(std::span<const double> signal,
                                                                    const Settings& settings);

}  // namespace loopscope::core::hos
