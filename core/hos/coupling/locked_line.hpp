#pragma once

#include "core/hos/transforms/spectra.hpp"

namespace loopscope::core::hos {

/// Largest |<X(k)>|^2 / <|X(k)|^2> over the bins, times K and over what noise has there (1, more
/// where overlapping segments add up in phase): how firmly a line keeps its phase from segment to
/// segment. It does so when its period divides the hop (16 or 32 samples for the paper's settings);
/// what leaks of it into three bins is then coherent in all segments and looks coupled. About
/// ln(number of bins) for noise; 0 where no bin has power.
[[nodiscard]] double line_lock(const Spectra& spectra);

/// Whether line_lock() is above what white noise reaches in at most one of a thousand records.
[[nodiscard]] bool has_locked_line(const Spectra& spectra);

}  // namespace loopscope::core::hos
