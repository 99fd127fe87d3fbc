#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace loopscope::daemon {

/// How the end of a slot is found (contract.md, "Recordings and windows").
enum class SlotRule {
  clock,          ///< run: the database's time minus the settling time, floored to the period
  newest_sample,  ///< once, and where a historian's clock is wrong: the newest sample, floored
};

/// The last whole multiple of `period_s` since 1970 that is not after `time_us`.
[[nodiscard]] std::int64_t floor_to_period(std::int64_t time_us, double period_s);

/// The slot to analyse next when `newest_us` is the newest one that has settled: the one after
/// `last_completed_us`, so that slots which passed while nobody worked are made up for, oldest
/// first, but none that lies more than `catch_up` slots before the newest. nullopt = none was
/// completed.
[[nodiscard]] std::int64_t slot_to_analyse(std::int64_t newest_us,
                                           std::optional<std::int64_t> last_completed_us,
                                           double period_s, int catch_up);

/// Ends of up to `count` slots before `slot_end_us`, newest first, whose rows may have come late:
/// the slot that was completed last (`last_completed_us`; a period earlier where that is unknown or
/// is this very slot), and those before it, a period apart.
[[nodiscard]] std::vector<std::int64_t> earlier_slots(std::int64_t slot_end_us,
                                                      std::optional<std::int64_t> last_completed_us,
                                                      double period_s, int count);

/// When a loop whose slot `slot_end_us` is done has to be looked at again: as soon as the next
/// slot has settled.
[[nodiscard]] std::int64_t next_due(std::int64_t slot_end_us, double period_s, double settle_s);
/// The same where the slot is that of the newest rows, however old these are: with the next slot by
/// the clock at the earliest, or the loop would be due again at once, before all others.
[[nodiscard]] std::int64_t next_due_by_rows(std::int64_t slot_end_us, std::int64_t now_us,
                                            double period_s, double settle_s);

/// Pause before a loop that failed `attempts` times in a row is tried again: doubles from one
/// minute up to six hours.
[[nodiscard]] double retry_pause_s(int attempts);

}  // namespace loopscope::daemon
