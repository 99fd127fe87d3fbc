#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "daemon/service/shared/judge_clocks.hpp"
#include "storage/error.hpp"
#include "storage/server_clock.hpp"

namespace loopscope::daemon {

/// The clocks that this process has seen: of the results server, of its host, of the historians.
/// Whoever reads one notes it here, and nothing is claimed or written without check_results(). A
/// historian that was read once goes on by this process' own count of seconds, so that a jump of
/// another clock meets a witness even where no historian answers just now. Thread-safe.
class KnownClocks {
 public:
  using Steady = std::chrono::steady_clock;
  /// What tells the time here; replaced in tests.
  struct Here {
    std::function<std::int64_t()> now_us;         ///< the host's clock, microseconds UTC
    std::function<Steady::time_point()> elapsed;  ///< runs on whatever clocks are set to
  };

  KnownClocks();
  explicit KnownClocks(Here here);

  /// The historian `source` says so.
  void note_historian(const std::string& source, const storage::ServerClock& clock);
  /// Historians of the settings in force; others are forgotten.
  void keep_historians(const std::vector<std::string>& sources);
  /// What a person has said, in place of what was said before.
  void accept(storage::AcceptedClocks accepted);

  /// All that is known.
  struct State {
    ClockReading host;
    std::vector<ClockReading> historians;  ///< those that share no clock with the results server
    ClockJudgement judgement;
  };
  /// The results server says so: how its clock stands beside the others.
  State note_results(const storage::ServerClock& clock);
  /// Notes it and throws DatabaseError (retry) unless it is believed: what a ResultsDatabase asks.
  /// This has to outlive it.
  [[nodiscard]] storage::ClockCheck check();
  /// Whether the historian's clock differs from those of the results server and of this host, as
  /// the results server's was noted last. False of a clock that is not known, and before the first
  /// note_results().
  [[nodiscard]] bool is_wrong(const std::string& source);

 private:
  struct Reading {
    storage::ServerClock clock;
    Steady::time_point at;
  };
  [[nodiscard]] std::int64_t now_us(const Reading& reading) const;
  [[nodiscard]] State judge() const;

  Here here_;
  std::mutex mutex_;
  std::optional<Reading> results_;
  std::map<std::string, Reading> historians_;
  storage::AcceptedClocks accepted_;
};

/// Why nothing is claimed or written (Remedy::retry); nullopt = the results server's clock is
/// believed.
[[nodiscard]] std::optional<storage::DatabaseError> refusal(const KnownClocks::State& state);

}  // namespace loopscope::daemon
