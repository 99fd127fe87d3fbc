#pragma once

#include "core/diagnosis/evidence.hpp"
#include "core/model/explanation.hpp"

namespace loopscope::core::diagnosis {

/// The closed loop that controller and fitted process make is close to instability.
[[nodiscard]] bool poorly_damped(const model::ClosedLoop& loop);

/// Its integral action is several times weaker than the SIMC rules give for that process. False for
/// integrating processes, which are often meant to be slow.
[[nodiscard]] bool far_slower_than_possible(const model::ClosedLoop& loop,
                                            const model::ProcessFit& process);

/// It is weaker at all, by more than the fit is off: as much as a witness has to say who is not the
/// only one.
[[nodiscard]] bool slower_than_possible(const model::ClosedLoop& loop,
                                        const model::ProcessFit& process);

/// The closed loop takes far longer to make up for a load than the process takes to settle by
/// itself. False without integral action, which never makes up for it.
[[nodiscard]] bool slower_than_open_loop(const model::ClosedLoop& loop,
                                         const model::ProcessFit& process);

/// The error oscillates at the period of the implied loop's dominant poles. False where one of the
/// two does not oscillate.
[[nodiscard]] bool at_resonance(const Evidence& evidence, const model::ClosedLoop& loop);

}  // namespace loopscope::core::diagnosis
