#pragma once

#include "core/diagnosis/evidence.hpp"
#include "core/model/explanation.hpp"

namespace loopscope::core::diagnosis {

/// The closed loop that controller and fitted process make is close to instability.
[[nodiscard]] bool poorly_damped(const model::ClosedLoop& loop);

/// It does not decay at all, which no loop under noise does: a line from outside draws the poles of
/// a fit onto the unit circle.
[[nodiscard]] bool undamped(const model::ClosedLoop& loop);

/// Its integral action is several times weaker than the SIMC rules give for that process. False for
/// integrating processes, which are often meant to be slow.
[[nodiscard]] bool far_slower_than_possible(const model::ClosedLoop& loop,
                                            const model::ProcessFit& process);

/// The closed loop takes far longer to make up for a load than the process takes to settle by
/// itself. False without integral action, which never makes up for it.
[[nodiscard]] bool slower_than_open_loop(const model::ClosedLoop& loop,
                                         const model::ProcessFit& process);

/// The error of a loop forgets within the closed loop's time constant. Lambda tuning's most careful
/// advice makes that three times the process's own, which the integral time is set to.
inline constexpr double kLongMemory = 3.0;

/// The longest plausible delay is a bound and no fact. Where it is most of what the memory is
/// measured by, an error that remembers longer than this, and is far from the best by the Harris
/// index, is named slow; not surely enough for a flag (README.md).
inline constexpr double kDoubtfulMemory = 1.65;

/// How long the error remembers (loop::Performance), by the controller's integral time and the
/// longest plausible delay: what a loop with a gain to speak of needs to make up for a load. 0
/// where the memory was not measured, or without integral action.
[[nodiscard]] double memory_ratio(const model::ClosedLoop& loop,
                                  const loop::Performance& performance);

/// The error oscillates at the period of the implied loop's dominant poles. False where one of the
/// two does not oscillate.
[[nodiscard]] bool at_resonance(const Evidence& evidence, const model::ClosedLoop& loop);

}  // namespace loopscope::core::diagnosis
