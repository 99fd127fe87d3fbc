#pragma once

#include "core/signal/loop_window.hpp"

namespace loopscope::core::loop {

/// What is left of the control error without the loop's linear answer to its setpoint.
///
/// The error on 12 samples of its own past and on the last 41 moves of the setpoint: the loop's
/// sensitivity, whatever process and controller are, as long as the dead time is below 40 samples.
/// First on the moves alone by least squares, then on both with the answer so found as instrument
/// for the error's past, which the loads are in as well (instrumental variables; Soderstrom and
/// Stoica 1983). The answer alone is simulated and taken off, so that what is left keeps its
/// colour. `error` and `sp` of equal length, NaN = missing; missing setpoints are taken for
/// unmoved.
///
/// Empty when the setpoint does not move, when too little is recorded in one piece, or when no
/// answer makes the error smaller: then the error has to do.
[[nodiscard]] signal::Samples without_setpoint_answer(const signal::Samples& error,
                                                      const signal::Samples& sp);

}  // namespace loopscope::core::loop
