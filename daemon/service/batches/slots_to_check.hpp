#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "daemon/service/batches/batch.hpp"
#include "daemon/service/windows/loop_slot.hpp"

namespace loopscope::daemon {

/// Loop and slot of everything that may be stored already: the newest slots and `horizon` earlier
/// ones of each loop, its last one in any case, by which kept windows are known.
[[nodiscard]] std::vector<std::pair<std::int64_t, std::int64_t>> slots_that_may_be_stored(
    const Claims& claims, std::span<const LoopSlot> newest, int horizon);

/// Earlier slots of several loops; `claims` says whose each is.
struct EarlierSlots {
  std::vector<LoopSlot> slots;
  Claims claims;
};

/// Slots before the newest ones of a batch that are looked at again, newest first: those of the
/// horizon that are stored and were analysed with the settings in force (others keep what they were
/// judged by), but for those whose rows are known to be as they were.
[[nodiscard]] EarlierSlots earlier_slots_to_check(const Batch& batch, int horizon);

}  // namespace loopscope::daemon
