#include "daemon/service/shared/kept_errors.hpp"

namespace loopscope::daemon {
namespace {

using core::plant::PackedError;

std::size_t bytes_of(const PackedError& error) {
  return error.size() * sizeof(std::int16_t);
}

}  // namespace

void KeptErrors::allow(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  room_bytes_ = bytes;
}

void KeptErrors::keep(std::int64_t loop_id, std::int64_t slot_end_us, PackedError&& error) {
  const std::lock_guard lock(mutex_);
  const std::size_t bytes = bytes_of(error);
  if (bytes == 0 || bytes > room_bytes_) return;
  const std::pair window(loop_id, slot_end_us);
  if (errors_.try_emplace(window, std::move(error)).second) room_bytes_ -= bytes;
}

std::optional<PackedError> KeptErrors::take(std::int64_t loop_id, std::int64_t slot_end_us) {
  const std::lock_guard lock(mutex_);
  auto found = errors_.extract({loop_id, slot_end_us});
  if (found.empty()) return std::nullopt;
  room_bytes_ += bytes_of(found.mapped());
  return std::move(found.mapped());
}

}  // namespace loopscope::daemon
