#include "daemon/service/shared/kept_errors.hpp"

namespace loopscope::daemon {

using core::plant::PackedError;

bool KeptErrors::has_room() {
  const std::lock_guard lock(mutex_);
  return room_bytes_ > 0;
}

void KeptErrors::allow(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  room_bytes_ = bytes;
}

void KeptErrors::keep(std::int64_t loop_id, std::int64_t slot_end_us, PackedError&& error) {
  const std::lock_guard lock(mutex_);
  const std::size_t bytes = error.bytes();
  if (bytes == 0 || bytes > room_bytes_) return;
  const std::pair window(loop_id, slot_end_us);
  if (errors_.try_emplace(window, std::move(error)).second) room_bytes_ -= bytes;
}

std::optional<PackedError> KeptErrors::take(std::int64_t loop_id, std::int64_t slot_end_us) {
  const std::lock_guard lock(mutex_);
  auto found = errors_.extract({loop_id, slot_end_us});
  if (found.empty()) return std::nullopt;
  room_bytes_ += found.mapped().bytes();
  return std::move(found.mapped());
}

}  // namespace loopscope::daemon
