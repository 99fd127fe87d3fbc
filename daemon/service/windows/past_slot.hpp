#pragma once

#include <cstdint>

#include "daemon/service/windows/newest_slots.hpp"

namespace loopscope::daemon {

/// A slot that was analysed before, to be read again: its pv had rows then, so nobody has to ask
/// which of the tags are alive. `loop` has to outlive it.
[[nodiscard]] LoopSlot past_slot(const storage::CatalogueEntry& loop, std::int64_t slot_end_us);

}  // namespace loopscope::daemon
