#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "storage/results/leases/schedule_health.hpp"

namespace loopscope::daemon {

/// The answer of /livez or /readyz.
struct HealthAnswer {
  bool well = true;
  std::string text;  ///< "ok", or one line per reason; each ends in a line break
  [[nodiscard]] int http_status() const { return well ? 200 : 503; }
};

struct HealthLimits {
  double max_silence_s = 60.0;  ///< since the results database answered last
  double max_lag_s = 3600.0;    ///< that the most overdue loop may be late
};

/// What stands behind /livez and /readyz. Thread-safe.
///
/// Live: the process does its work or waits for something outside; if not, only a restart helps.
/// Ready: what is outside is there too and the work keeps up. A database that is away makes a
/// worker not ready, never not live: to restart it would mend nothing.
class Health {
 public:
  using Clock = std::chrono::steady_clock;
  using WhyNotLive = std::function<std::optional<std::string>()>;

  /// `why_not_live` names the thread that should have advanced and has not; it is called from the
  /// threads that ask live(). `now` is for tests.
  Health(WhyNotLive why_not_live, HealthLimits limits,
         std::function<Clock::time_point()> now = Clock::now);

  void set_limits(HealthLimits limits);
  /// The results database has answered, and its schema is this program's.
  void results_answered();
  /// It has answered, but with a schema that is not this program's; `why` in plain words. Stands
  /// until results_answered().
  void schema_refused(std::string why);
  /// The lag of the newest look at the schedule.
  void set(const storage::ScheduleHealth& schedule);
  /// Why the results server's clock is not believed; nullopt = it is.
  void set_clock_refusal(std::optional<std::string> why);

  [[nodiscard]] HealthAnswer live() const;
  [[nodiscard]] HealthAnswer ready() const;

 private:
  [[nodiscard]] std::vector<std::string> why_not_ready() const;

  WhyNotLive why_not_live_;
  std::function<Clock::time_point()> now_;
  mutable std::mutex mutex_;
  HealthLimits limits_;
  std::optional<Clock::time_point> answered_at_;
  std::optional<std::string> schema_refusal_;
  std::optional<std::string> clock_refusal_;
  double lag_s_ = 0.0;
};

}  // namespace loopscope::daemon
