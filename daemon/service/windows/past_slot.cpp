#include "daemon/service/windows/past_slot.hpp"

#include "daemon/catalogue/tag_roles.hpp"

namespace loopscope::daemon {

LoopSlot past_slot(const storage::CatalogueEntry& loop, std::int64_t slot_end_us) {
  LoopSlot slot{&loop, slot_end_us, {}};
  for (const TagRole& role : kTagRoles) {
    if ((loop.*role.tag).empty()) continue;
    TagReading reading;
    reading.role = role.name;
    reading.newest_row_us = slot_end_us;
    slot.tags.push_back(reading);
  }
  return slot;
}

}  // namespace loopscope::daemon
