#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <utility>

#include "config/settings.hpp"
#include "daemon/service/observe/fault_log.hpp"
#include "daemon/service/shared/known_clocks.hpp"
#include "daemon/service/threads/pauses.hpp"
#include "storage/results/results_database.hpp"

namespace loopscope::daemon {

/// How long a worker tries to bring its work to the results database.
enum class RetryLimit {
  one_lease,  ///< once: for schedule.lease_s seconds, since whoever called wants to know
  endless,    ///< run: until it works or the process shall stop
};

/// One user's connection to the results database: made at the first use, thrown away when it dies,
/// made anew at the next use. For one thread at a time.
class ResultsLink {
 public:
  ResultsLink(std::shared_ptr<const config::Settings> settings, FaultLog& faults, Metrics& metrics,
              KnownClocks& clocks, std::stop_token stop,
              std::shared_ptr<storage::ClaimWatermarks> watermarks)
      : settings_(std::move(settings)),
        faults_(faults),
        metrics_(metrics),
        clocks_(clocks),
        stop_(std::move(stop)),
        watermarks_(std::move(watermarks)) {}
  ~ResultsLink() { faults_.leave(kSubject, this); }
  ResultsLink(const ResultsLink&) = delete;
  ResultsLink& operator=(const ResultsLink&) = delete;

  /// Calls `use(storage::ResultsDatabase&)`; a second time, on a new connection, when the one from
  /// before turns out to be dead, which says nothing about the server. So `use` has to bear a
  /// repeat after a commit in doubt; it returns a value. Throws storage::DatabaseError.
  template <typename Use>
  auto with(Use use) {
    const bool was_connected = database_.has_value();
    try {
      return try_once(use);
    } catch (const storage::DatabaseError& error) {
      if (!was_connected || error.remedy() != storage::Remedy::reconnect) throw;
      metrics_.reconnected("results");
      return try_once(use);
    }
  }

  /// Calls `use` until it works: a database that is away or full comes back, and the work is done
  /// already. What a repeat cannot mend is thrown, as is everything after a stop was requested or
  /// perseverance has ended. `step()` is called at each try.
  template <typename Use, typename Step>
  auto with_retry(RetryLimit perseverance, Use use, Step step) {
    RetryPause pause(settings_->schedule.poll_s);
    for (double waited_s = 0.0;;) {
      step();
      try {
        return with(use);
      } catch (const storage::DatabaseError& error) {
        if (!may_pass(error) || waited_s > patience_s(perseverance)) throw;
        say(error);
        const double pause_s = pause.next_s();
        if (!sleep_for(stop_, std::chrono::duration<double>(pause_s))) throw;
        waited_s += pause_s;
      }
    }
  }

  /// Logs the fault; the next use of this link that works ends it for this one.
  void say(const storage::DatabaseError& error);

 private:
  template <typename Use>
  auto try_once(Use use) {
    try {
      auto result = use(database());
      faults_.recovered(kSubject, this);
      return result;
    } catch (const storage::DatabaseError& error) {
      if (is_stale(error)) database_.reset();
      throw;
    }
  }

  static constexpr const char* kSubject = "results database";
  storage::ResultsDatabase& database();
  [[nodiscard]] static bool may_pass(const storage::DatabaseError& error);
  [[nodiscard]] static bool is_stale(const storage::DatabaseError& error);
  [[nodiscard]] double patience_s(RetryLimit perseverance) const;

  std::shared_ptr<const config::Settings> settings_;
  FaultLog& faults_;
  Metrics& metrics_;
  KnownClocks& clocks_;
  std::stop_token stop_;
  std::shared_ptr<storage::ClaimWatermarks> watermarks_;
  std::optional<storage::ResultsDatabase> database_;
};

}  // namespace loopscope::daemon
