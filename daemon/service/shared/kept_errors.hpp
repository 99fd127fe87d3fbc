#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "core/signal/loop_window.hpp"

namespace loopscope::daemon {

/// The control errors of windows that this process has analysed, for the comparison of all loops at
/// the end of a pass: what is kept is not read and made ready a second time. Thread-safe.
class KeptErrors {
 public:
  /// As core::signal::PreparedLoop has it.
  struct Record {
    double sample_interval_s = 1.0;
    std::int64_t start_us = 0;  ///< of the first sample, microseconds UTC since 1970
    core::signal::Samples error;
  };

  /// So many bytes of samples are kept, the first that come; 0 at first.
  void allow(std::size_t bytes);
  /// The error of a window, named by its slot's end; ignored where it does not fit any more.
  void keep(std::int64_t loop_id, std::int64_t slot_end_us, Record&& record);
  /// Gives it away; nullopt = it was not kept.
  [[nodiscard]] std::optional<Record> take(std::int64_t loop_id, std::int64_t slot_end_us);

 private:
  std::mutex mutex_;
  std::size_t room_bytes_ = 0;
  std::map<std::pair<std::int64_t, std::int64_t>, Record> records_;
};

}  // namespace loopscope::daemon
