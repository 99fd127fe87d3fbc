#pragma once

#include <cstddef>

#include "core/signal/prepared_loop.hpp"

namespace loopscope::core::signal {

/// The control error with what follows each step of the setpoint taken out.
struct ErrorBetweenSteps {
  Samples error;  ///< drawable.error of the loop, or its error; pv units; NaN = missing in the
                  ///< loop's error, or masked
  std::size_t steps = 0;         ///< steps (and returns from manual) that call for a mask
  double masked_fraction = 0.0;  ///< of the recorded error samples, 0 to 0.6; 0 = nothing masked
};

/// The error of `loop` without the transient after every setpoint step.
///
/// A step makes the error jump and decay. A linear loop that is stepped every few hundred samples
/// has a wildly non-Gaussian error, and every test for nonlinearity fires on it; only the stretches
/// between the transients tell what the loop is.
///
/// A step is a move of sp in one direction, over one or several samples in a row, by more than
/// half of the error's usual (robust) standard deviation. A return from manual counts as one of any
/// size. From its first sample on the error is masked until its distance from its median is an
/// ordinary one again, and for as long once more (at least 32 samples), at most 512 samples after
/// the move. Whether it has settled is judged on masked samples only, so calm stretches are not
/// preferred among those that stay.
///
/// Nothing is masked (steps > 0, masked_fraction = 0, error as it is) when more than 60 % of the
/// recorded samples would go: a cascade slave, a ratio loop or a ramp has no state between its
/// moves. Whether enough unbroken segments stay is for the caller to judge; the raw error stays in
/// `loop`. Without a setpoint, or with a constant error, there is nothing to mask.
[[nodiscard]] ErrorBetweenSteps error_between_steps(const PreparedLoop& loop);

}  // namespace loopscope::core::signal
