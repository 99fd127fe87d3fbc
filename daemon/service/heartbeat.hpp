#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "config/settings.hpp"
#include "daemon/service/shared/results_link.hpp"
#include "daemon/service/shared/shared_services.hpp"

namespace loopscope::daemon {

/// Extends the leases of what the workers hold, three times while a claim holds, on a thread and a
/// connection of its own; only of workers that got on since (ProgressBoard). So a batch that takes
/// long keeps its loops, while a worker that hangs loses them to others. Workers learn which loops
/// were lost meanwhile. Signs the process in loopscope.worker.
class Heartbeat {
 public:
  using Clock = std::chrono::steady_clock;

  Heartbeat(std::shared_ptr<const config::Settings> settings, SharedServices& tools);

  /// New settings are in force from the next beat on.
  void use(std::shared_ptr<const config::Settings> settings);
  /// Leases lost to others since the start. Thread-safe, as silence() and use() are.
  [[nodiscard]] std::uint64_t lost_leases();
  /// Since the last beat, whether it reached the database or not.
  [[nodiscard]] Clock::duration silence(Clock::time_point now = Clock::now());

 private:
  void run(const std::stop_token& stop);
  /// Seconds until the next beat.
  double beat();
  void leave();
  void extend(storage::ResultsDatabase& database, double hold_s);

  SharedServices& tools_;
  std::mutex mutex_;  ///< over what follows, up to the thread's own
  std::condition_variable_any changed_;
  std::shared_ptr<const config::Settings> settings_;
  std::uint64_t lost_leases_ = 0;
  Clock::time_point last_beat_ = Clock::now();

  // The thread's own.
  std::shared_ptr<const config::Settings> linked_with_;
  std::optional<ResultsLink> link_;
  RetryPause pause_;
  bool heard_ = false;   ///< the last beat reached the database
  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace loopscope::daemon
