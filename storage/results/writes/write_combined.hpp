#pragma once

#include <cstdint>
#include <map>

#include "core/diagnosis/verdicts/verdict.hpp"
#include "storage/loop_work.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {

/// What has changed of a loop's stored slots, microseconds UTC since 1970.
struct ChangedSlots {
  std::int64_t first_us;     ///< end of the earliest of them
  std::int64_t earliest_us;  ///< slots before are forgotten (longest_memory_windows())
};

/// What a record that is written changes: its slot and those behind it. A record without rows has a
/// window of no length: those behind it are combined anew all the same, by windows of at most a
/// day.
[[nodiscard]] ChangedSlots changed_by(const AnalysisRecord& record);

/// Combines the odds of each loop's windows (core/diagnosis/odds/combined_odds) from the first
/// changed slot on, by what is stored of them and of the combined one before: late data and a
/// replay of slots in any order come to the same. Only rows of `algorithm_revision` are combined;
/// what a row keeps of its windows knows no priors, `priors` are those of the probabilities beside
/// it. A window that stands alone keeps the probabilities that it was judged with. `changed` is by
/// loop_id. In the caller's transaction, by Session::transact().
void write_combined(Transaction& transaction, int algorithm_revision,
                    const std::map<std::int64_t, ChangedSlots>& changed,
                    const core::diagnosis::PerCause& priors);

}  // namespace loopscope::storage
