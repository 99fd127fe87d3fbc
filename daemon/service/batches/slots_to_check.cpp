#include "daemon/service/batches/slots_to_check.hpp"

#include <algorithm>
#include <cstddef>

#include "daemon/service/windows/slot.hpp"

namespace loopscope::daemon {
namespace {

bool is_to_be_checked(const storage::ClaimedLoop& claim, std::int64_t end_us, const Batch& batch) {
  const storage::StoredDigest* row = batch.stored.find(claim.loop.loop_id, end_us);
  return row != nullptr && row->same_settings &&
         !batch.kept.still_holds(claim, end_us, batch.stored);
}

}  // namespace

std::vector<std::pair<std::int64_t, std::int64_t>> slots_that_may_be_stored(
    const Claims& claims, std::span<const LoopSlot> newest, int horizon) {
  std::vector<std::pair<std::int64_t, std::int64_t>> keys;
  for (std::size_t k = 0; k < claims.size(); ++k) {
    const storage::ClaimedLoop& claim = *claims[k];
    const std::int64_t loop_id = claim.loop.loop_id, newest_us = newest[k].end_us;
    keys.emplace_back(loop_id, newest_us);
    for (const std::int64_t end : earlier_slots(newest_us, claim.last_slot_end_us,
                                                claim.loop.period_s, std::max(horizon, 1))) {
      keys.emplace_back(loop_id, end);
    }
  }
  return keys;
}

EarlierSlots earlier_slots_to_check(const Batch& batch, int horizon) {
  EarlierSlots earlier;
  for (const LoopTask& task : batch.tasks) {
    const LoopWindowAtSlot& newest = task.newest.at_slot;
    const storage::ClaimedLoop& claim = *task.claim;
    for (const std::int64_t end :
         earlier_slots(newest.slot_end_us, claim.last_slot_end_us, claim.loop.period_s, horizon)) {
      if (!is_to_be_checked(claim, end, batch)) continue;
      earlier.slots.push_back({&claim.loop, end, newest.tags, claim.pv_past});
      earlier.claims.push_back(task.claim);
    }
  }
  return earlier;
}

}  // namespace loopscope::daemon
