#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>

#include "config/settings.hpp"
#include "storage/error.hpp"

namespace loopscope::daemon {

/// Admission to one source: at most so many users at a time, and after a failure one that tries
/// while all others are turned away at once, so that a source that is down costs nobody but it
/// anything. Who is inside waits for no other gate, so nothing can lock up. Thread-safe.
class SourceGate {
 public:
  using Duration = std::chrono::steady_clock::duration;

  /// Waits until fewer than `limit` (> 0) users are inside, then goes in. Throws the standing fault
  /// of a source that is down, or DatabaseError (retry) when no place came free within `patience`.
  void enter(const std::string& source, int limit, Duration patience);
  /// The user leaves; the source worked.
  void leave();
  /// The user leaves because the source is down; those who wait are turned away, and so is
  /// everybody for as long as `pause`.
  void leave_down(const storage::DatabaseError& fault, Duration pause);

  [[nodiscard]] bool is_down();
  /// Time until somebody may try a source that is down, 0 = somebody tries it now; nullopt =
  /// whoever comes may go in.
  [[nodiscard]] std::optional<Duration> closed_for();
  [[nodiscard]] int inside();

 private:
  using Clock = std::chrono::steady_clock;
  void throw_if_down();

  std::mutex mutex_;
  std::condition_variable changed_;
  int inside_ = 0;
  std::optional<storage::DatabaseError> fault_;
  Clock::time_point try_again_at_;
};

/// How long a user of a source waits.
struct SourceTerms {
  SourceGate::Duration patience;  ///< longest wait for a free connection
  SourceGate::Duration pause;     ///< for which a source that failed is left alone
  double hold_s = 290.0;          ///< seconds that the claims hold: bounds every wait
};

/// Seconds, a poll or 30 at most, for which a historian that failed is left alone: its loops go on
/// soon after it is back.
[[nodiscard]] double source_pause_s(const config::ScheduleSettings& schedule);

/// The waits of a reader of windows.
[[nodiscard]] SourceTerms source_terms(const config::ScheduleSettings& schedule);

}  // namespace loopscope::daemon
