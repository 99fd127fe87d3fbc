#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "daemon/service/windows/slot.hpp"
#include "storage/historian/historian_reader.hpp"
#include "storage/results/results_database.hpp"

namespace loopscope::daemon {

/// What the historian holds of one tag of a loop, as far as it tells whether the tag is alive.
struct TagReading {
  std::string_view role;                      ///< sp, pv, op, mv or mode
  std::optional<std::int64_t> newest_row_us;  ///< not in the future; nullopt = no row at all
  std::int64_t asked_us = 0;                  ///< the historian's clock then
  std::size_t future_rows = 0;   ///< stamped later than the clock allows; never read as data
  std::size_t rows = 0;          ///< read for the window
  std::size_t bad_rows = 0;      ///< of those, of bad quality or no number
  std::size_t surplus_rows = 0;  ///< the window was cut off at so many rows; 0 = it was not
  std::size_t unknown_rows = 0;  ///< of those, with a quality code that nobody knows
};

using TagReadings = std::vector<TagReading>;

/// The reading of a role; nullptr when the loop has no such tag.
[[nodiscard]] inline const TagReading* find_reading(const TagReadings& readings,
                                                    std::string_view role) {
  for (const TagReading& reading : readings) {
    if (reading.role == role) return &reading;
  }
  return nullptr;
}

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

/// The past slots that loops of ONE historian were claimed for, in their order: one round trip.
/// Like the slots of the newest samples (SlotRule), there is none where pv has no row from the
/// slot's end on to that of the next one; its tags say so: pv has no newest row. Throws
/// storage::DatabaseError.
[[nodiscard]] std::vector<LoopSlot> claimed_past_slots(
    storage::HistorianReader& historian, std::span<const storage::ClaimedLoop* const> claims);

/// A slot that was analysed before, to be read again: its pv had rows then, so nobody has to ask
/// which of the tags are alive. `loop` has to outlive it.
[[nodiscard]] LoopSlot past_slot(const storage::CatalogueEntry& loop, std::int64_t slot_end_us);

}  // namespace loopscope::daemon
