#pragma once

#include "core/signal/loop_window.hpp"

namespace loopscope::core::loop {

/// What is left of the control error without the loop's linear answer to its setpoint.
///
/// The error on 12 samples of its own past and on the last 41 moves of the setpoint: the loop's
/// sensitivity, whatever process and controller are, as long as the dead time is below 40 samples.
/// On the moves alone, and on both by least squares and by instrumental variables (Soderstrom and
/// Stoica 1983); the model whose answer, simulated from rest, leaves least stands. That answer is
/// taken off, so that what is left keeps its spectrum. `error` and `sp` in pv units, NaN = missing;
/// missing setpoints are taken for unmoved. The result is as long as `error`, in its unit.
///
/// Empty when the lengths differ, when the setpoint does not move, when too little is recorded in
/// one piece (6 rows for each of 54 coefficients), or when no answer makes the error smaller.
[[nodiscard]] signal::Samples without_setpoint_response(const signal::Samples& error,
                                                        const signal::Samples& sp);

}  // namespace loopscope::core::loop
