#pragma once

#include <vector>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// What the two neighbours on either side do not tell of each sample: x(k) less
/// b1 (x(k-1) + x(k+1)) + b2 (x(k-2) + x(k+2)), both about the mean, by least squares.
///
/// This is the best guess from both sides for an autoregressive signal of order two, and no worse
/// than the mean for white noise, where a median of neighbours adds noise of its own. Rows that
/// touch a sample of `suspect` (empty, or as long as `samples`) do not enter the fit. 0 where a
/// neighbour is missing, and everywhere when the fit has no rows or no variance.
[[nodiscard]] std::vector<double> neighbour_errors(const Samples& samples,
                                                   const std::vector<bool>& suspect);

}  // namespace loopscope::core::signal
