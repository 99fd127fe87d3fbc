#include "daemon/service/shared/kept_errors.hpp"

namespace loopscope::daemon {
namespace {

std::size_t bytes_of(const KeptErrors::Record& record) {
  return record.error.size() * sizeof(double);
}

}  // namespace

void KeptErrors::allow(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  room_bytes_ = bytes;
}

void KeptErrors::keep(std::int64_t loop_id, std::int64_t slot_end_us, Record&& record) {
  const std::lock_guard lock(mutex_);
  const std::size_t bytes = bytes_of(record);
  if (bytes == 0 || bytes > room_bytes_) return;
  if (records_.try_emplace({loop_id, slot_end_us}, std::move(record)).second) room_bytes_ -= bytes;
}

std::optional<KeptErrors::Record> KeptErrors::take(std::int64_t loop_id, std::int64_t slot_end_us) {
  const std::lock_guard lock(mutex_);
  auto found = records_.extract({loop_id, slot_end_us});
  if (found.empty()) return std::nullopt;
  room_bytes_ += bytes_of(found.mapped());
  return std::move(found.mapped());
}

}  // namespace loopscope::daemon
