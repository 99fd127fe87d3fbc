#pragma once

#include <cstddef>
#include <span>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::daemon {

/// The squared bicoherence at one bifrequency anywhere, also where f1 + f2 > 0.5, and the segments
/// that it averages.
struct BifrequencyEstimate {
  double bic2 = 0.0;
  std::size_t segments = 0;
};

/// Same segments, window and normalisation as core::hos (eq. 2), by a Fourier sum at f1, f2 and
/// f1 + f2 (cycles per sample) instead of a transform: for bifrequencies outside the principal
/// domain. bic2 is 0 when a mean power is 0.
[[nodiscard]] BifrequencyEstimate estimate_at(std::span<const double> signal, double f1, double f2,
                                              const core::hos::Settings& settings);

}  // namespace loopscope::daemon
