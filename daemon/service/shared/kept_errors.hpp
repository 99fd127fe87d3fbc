#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "core/plant/packed_error.hpp"

namespace loopscope::daemon {

/// The control errors of windows that this process has analysed, for the comparison of all loops at
/// the end of a pass: what is kept is not read and made ready a second time. Thread-safe.
class KeptErrors {
 public:
  /// So many bytes of samples are kept, the first that come; 0 at first.
  void allow(std::size_t bytes);
  /// Whether keep() may keep one: packing it for nothing can be spared.
  [[nodiscard]] bool has_room();
  /// The error of a window, named by its slot's end; ignored where it does not fit any more.
  void keep(std::int64_t loop_id, std::int64_t slot_end_us, core::plant::PackedError&& error);
  /// Gives it away; nullopt = it was not kept.
  [[nodiscard]] std::optional<core::plant::PackedError> take(std::int64_t loop_id,
                                                             std::int64_t slot_end_us);

 private:
  std::mutex mutex_;
  std::size_t room_bytes_ = 0;
  std::map<std::pair<std::int64_t, std::int64_t>, core::plant::PackedError> errors_;
};

}  // namespace loopscope::daemon
