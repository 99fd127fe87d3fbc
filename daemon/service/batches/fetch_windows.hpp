#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "config/settings.hpp"
#include "daemon/service/batches/loop_task.hpp"
#include "daemon/service/windows/row_memory.hpp"
#include "daemon/service/windows/slot.hpp"
#include "storage/historian/historian_reader.hpp"

namespace loopscope::daemon {

/// A historian's time, and how the ends of its slots are found.
struct SourceTime {
  std::int64_t now_us = 0;
  SlotRule rule = SlotRule::clock;
};

/// Visits claimed loops of ONE historian: reads the newest slot of each, in the order of `claims`.
/// Throws storage::DatabaseError.
[[nodiscard]] std::vector<LoopTask> visit_newest(
    storage::HistorianReader& historian, std::span<const storage::ClaimedLoop* const> claims,
    const config::Settings& settings, const SourceTime& time, RowMemory& memory,
    const AnalysisContext& place);

/// Loop and slot of everything that the visits may find stored: the newest slots and `horizon`
/// earlier ones of each loop.
[[nodiscard]] std::vector<std::pair<std::int64_t, std::int64_t>> slots_that_may_be_stored(
    std::span<const LoopTask> visits, int horizon);

/// Earlier slots to look at again, all visits in one list; `visit` says whose each is.
struct EarlierSlots {
  std::vector<LoopSlot> slots;
  std::vector<std::size_t> visit;
};
[[nodiscard]] EarlierSlots earlier_slots_to_check(std::span<const LoopTask> visits,
                                                  const StoredAnalyses& stored, int horizon);

/// Reads those slots into their visits. Throws storage::DatabaseError and leaves them as they were.
void visit_earlier(storage::HistorianReader& historian, const EarlierSlots& earlier,
                   const config::Settings& settings, RowMemory& memory,
                   const AnalysisContext& place, std::span<LoopTask> visits);

}  // namespace loopscope::daemon
