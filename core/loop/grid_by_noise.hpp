#pragma once

#include <optional>
#include <span>

namespace loopscope::core::loop {

/// Grid of a recorded signal (its smallest step) over the standard deviation of the error of its
/// one-step prediction by an autoregression of order 20.
///
/// What cannot be predicted carries a signal across its grid. Well below 1 rounding is one more
/// white noise, of variance grid^2 / 12; above, values are repeated, and controller and statistics
/// see the grid (Widrow, Kollar, Liu 1996). The grid over the signal's own standard deviation does
/// not tell the two apart: a load that wanders slowly makes that large whatever the noise.
/// Tends to sqrt(12) where rounding is all the noise there is; a tiny number without a grid.
///
/// NaN = missing. nullopt: constant, predicted without an error, or fewer than 105 rows of 21
/// samples without a gap.
[[nodiscard]] std::optional<double> grid_by_noise(std::span<const double> signal);

}  // namespace loopscope::core::loop
