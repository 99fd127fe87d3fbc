#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "config/settings.hpp"
#include "daemon/service/shared/shared_services.hpp"
#include "storage/results/plant/plant_rounds.hpp"

namespace loopscope::daemon {

/// What is to be said of all loops together, on a thread of its own: compares them with each other
/// every `plant.round_s` (one worker of the plant at a time does), and tells listeners of the
/// results database of loops that are newly flagged (NOTIFY), every `plant.notice_s` or, where that
/// takes more than a twentieth of it, less often, whether the comparison succeeds or not; judges
/// repairs at every look, once a minute at least. Workers go on whatever happens here; a database
/// that is away is a fault for the log.
class PlantWatch {
 public:
  /// Starts the thread; the destructor ends it and waits for what it is at.
  PlantWatch(std::shared_ptr<const config::Settings> settings, SharedServices& tools);

  /// These settings from now on, by which it looks again at once. Thread-safe.
  void use(std::shared_ptr<const config::Settings> settings);

 private:
  void run(const std::stop_token& stop);
  using Clock = std::chrono::steady_clock;

  /// Does what is due; seconds until the next look.
  double look(const config::Settings& settings);
  /// The comparison and the notices, as far as the settings want them.
  double look_at_plant(const config::Settings& settings);
  /// One connection for all looks: to plan what is asked of all loops takes a new one several times
  /// as long (storage/MEASURED.md).
  void connect(const config::Settings& settings);
  /// Compares when it is time; seconds until it will be, nullopt = it failed.
  std::optional<double> compare(storage::PlantRounds& rounds, const config::Settings& settings);
  /// Announces when it is time; seconds until it will be.
  double announce_when_due(double every_s);
  /// Says who has the turn when it has been another's at many looks in a row.
  void count_refusal(const std::string& holder);

  SharedServices& tools_;
  std::optional<storage::PlantRounds> rounds_;  ///< until a look fails; of the thread
  Clock::time_point next_round_{};              ///< not before; of the thread
  Clock::time_point next_notice_{};             ///< likewise
  bool announced_ = true;                       ///< by the last look for notices
  int refusals_ = 0;  ///< looks in a row at which another had the turn; of the thread
  std::mutex mutex_;  ///< over settings_
  std::shared_ptr<const config::Settings> settings_;
  std::condition_variable_any changed_;
  std::jthread thread_;  // last: it ends before what it uses
};

/// What is to be said of all loops together, now, for a single pass: repairs judged, one comparison
/// of all loops, and the notices that follow; says in the log what it found. Another worker that is
/// at the comparison is left alone. Repairs that could not be judged are said in the log and thrown
/// behind the rest. Throws storage::DatabaseError and Failure.
void compare_all_loops(const config::Settings& settings, SharedServices& tools);

}  // namespace loopscope::daemon
