#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "config/settings.hpp"
#include "daemon/service/shared/shared_services.hpp"
#include "storage/results/plant/plant_rounds.hpp"

namespace loopscope::daemon {

/// One comparison of all loops (core/plant): candidates out of the results, their windows out of
/// the historians, shared oscillations into the results. `rounds` has the turn. nullopt = no loop
/// was analysed yet, or the process shall end. Throws storage::DatabaseError and Failure; then
/// nothing was stored, and the round before holds.
[[nodiscard]] std::optional<storage::PlantRoundRecord> make_plant_round(
    storage::PlantRounds& rounds, const config::Settings& settings, SharedServices& tools);

/// The round in a line for the log.
[[nodiscard]] std::string round_text(const storage::PlantRoundRecord& round);

}  // namespace loopscope::daemon
