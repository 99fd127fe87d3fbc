#pragma once

#include "core/diagnosis/evidence.hpp"
#include "core/model/explanation.hpp"

namespace loopscope::core::diagnosis {

/// The closed loop that controller and fitted process make is close to instability.
[[nodiscard]] bool poorly_damped(const model::ClosedLoop& loop);

/// It settles several times slower than a PI controller settles that process with ease. False for
/// integrating processes, which are often meant to be slow.
[[nodiscard]] bool far_slower_than_possible(const model::ClosedLoop& loop,
                                            const model::ProcessFit& process);

/// The error oscillates at the period of the implied loop's dominant poles. False where one of the
/// two does not oscillate.
[[nodiscard]] bool at_resonance(const Evidence& evidence, const model::ClosedLoop& loop);

}  // namespace loopscope::core::diagnosis
