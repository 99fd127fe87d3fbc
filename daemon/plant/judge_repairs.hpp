#pragma once

#include <cstddef>

#include "config/settings.hpp"
#include "daemon/service/shared/shared_services.hpp"
#include "storage/results/catalogue/repair_judgements.hpp"

namespace loopscope::daemon {

/// Judges whether work on loops helped (core/repair), wherever a loop has newer windows than at
/// the last time, and stores it; says in the log how much it was. Stops early when the process
/// shall end. Throws storage::DatabaseError; what was judged before it is stored.
void judge_repairs(const config::Settings& settings, SharedServices& tools);

/// One batch of it, a transaction to read and one to write; how many were judged, 0 = none is due.
std::size_t judge_some_repairs(storage::RepairJudgements& judgements);

}  // namespace loopscope::daemon
