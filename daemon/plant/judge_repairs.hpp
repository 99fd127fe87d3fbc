#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "config/settings.hpp"
#include "daemon/service/shared/shared_services.hpp"
#include "storage/results/catalogue/repair_judgements.hpp"

namespace loopscope::daemon {

/// Judges whether work on loops helped (core/repair) where it was not judged yet, or where windows
/// or work have changed since, each piece once, and stores it; says in the log how much it was.
/// Stops early when the process shall end. Throws storage::DatabaseError; what was judged before it
/// is stored.
void judge_repairs(const config::Settings& settings, SharedServices& tools);

/// The same; what was judged of these loops is judged anew, since windows of before their newest
/// ones were added.
void judge_repairs_anew(const config::Settings& settings, SharedServices& tools,
                        std::span<const std::int64_t> loop_ids);

/// So many pieces of work, the last of this number.
struct JudgedBatch {
  std::size_t count = 0;
  std::int64_t last = 0;
};

/// One batch of it, a hundred pieces at most, behind the piece of this number: a transaction to
/// read and one to write. A count of 0 = nothing more is due. Throws storage::DatabaseError.
JudgedBatch judge_some_repairs(storage::RepairJudgements& judgements, std::int64_t behind);

}  // namespace loopscope::daemon
