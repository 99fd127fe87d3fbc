#pragma once

#include <span>

#include "core/plant/shared_oscillation.hpp"
#include "storage/results/plant/write_plant_round.hpp"

namespace loopscope::daemon {

/// An event as the results keep it: its members with what speaks for and against each, who
/// foretells whom, and what is drawn of the strongest. `loops` = those that were compared.
[[nodiscard]] storage::PlantEvent event_record(const core::plant::SharedOscillation& event,
                                               std::span<const core::plant::MemberLoop> loops);

}  // namespace loopscope::daemon
