#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "daemon/service/windows/slot.hpp"
#include "daemon/service/windows/tag_reading.hpp"
#include "storage/historian/historian_reader.hpp"
#include "storage/results/results_database.hpp"

namespace loopscope::daemon {

/// One slot of one loop whose window is wanted.
struct LoopSlot {
  const storage::CatalogueEntry* loop = nullptr;
  std::int64_t end_us = 0;
  TagReadings tags;  ///< one for each tag of the loop; counts of rows are not known yet
  std::optional<core::signal::PvPast> pv_past = std::nullopt;  ///< before the slot's window
};

/// How the newest slot of a loop is found.
struct SlotSettings {
  double settle_s = 60.0;  ///< rows newer than this are left to settle
  SlotRule rule = SlotRule::clock;
  int catch_up = 0;  ///< slots before the newest that are made up for at most (rule clock)
};

/// The slot to analyse of claimed loops of ONE historian, in their order, and what is known of
/// their tags: two round trips whatever the number of loops. `now_us` is the historian's clock. No
/// slot ends later than `settle_s` before it, nor before the results server's; rows stamped in the
/// future are a fault of their sender's clock and end no slot. Throws storage::DatabaseError.
[[nodiscard]] std::vector<LoopSlot> newest_slots(
    storage::HistorianReader& historian, std::span<const storage::ClaimedLoop* const> claims,
    const SlotSettings& settings, std::int64_t now_us);

}  // namespace loopscope::daemon
