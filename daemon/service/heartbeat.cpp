#include "daemon/service/heartbeat.hpp"

#include <algorithm>
#include <spdlog/spdlog.h>

#include "core/diagnosis/diagnose.hpp"
#include "core/text/counted.hpp"
#include "daemon/service/threads/worker_identity.hpp"

namespace loopscope::daemon {
namespace {

/// Two beats may fail before a claim ends.
constexpr double kBeatsInAHold = 3.0;
/// Claims travel in batches of so many, so that one statement never holds many rows.
constexpr std::size_t kClaimsAtATime = 1000;

}  // namespace

Heartbeat::Heartbeat(std::shared_ptr<const config::Settings> settings, SharedServices& tools)
    : tools_(tools),
      settings_(std::move(settings)),
      pause_(settings_->schedule.poll_s),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void Heartbeat::use(std::shared_ptr<const config::Settings> settings) {
  const std::lock_guard lock(mutex_);
  settings_ = std::move(settings);
  changed_.notify_all();
}

std::uint64_t Heartbeat::lost_leases() {
  const std::lock_guard lock(mutex_);
  return lost_leases_;
}

Heartbeat::Clock::duration Heartbeat::silence(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  return now - last_beat_;
}

void Heartbeat::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const std::chrono::duration<double> pause(beat());
    std::unique_lock lock(mutex_);
    last_beat_ = Clock::now();
    changed_.wait_for(lock, stop, pause, [this] { return settings_ != linked_with_; });
  }
  leave();
}

/// No end waits for a database that is away: the worker is missed there after a lease.
void Heartbeat::leave() {
  if (!heard_) return;
  try {
    link_->with([](storage::ResultsDatabase& database) {
      database.leave_worker(process_name());
      return true;
    });
  } catch (const storage::DatabaseError&) {  // NOLINT(bugprone-empty-catch): as if nobody heard it
  }
}

double Heartbeat::beat() {
  std::shared_ptr<const config::Settings> settings;
  {
    const std::lock_guard lock(mutex_);
    settings = settings_;
  }
  if (settings != linked_with_) {
    link_.emplace(settings, tools_.faults, tools_.metrics, tools_.clocks, tools_.stop,
                  tools_.watermarks);
    linked_with_ = settings;
    pause_ = RetryPause(settings->schedule.poll_s);
  }
  const double interval_s = settings->schedule.hold_s() / kBeatsInAHold;
  heard_ = false;
  try {
    link_->with([&](storage::ResultsDatabase& database) {
      extend(database, settings->schedule.hold_s());
      return true;
    });
    pause_.reset();
    heard_ = true;
    tools_.faults.recovered("heartbeat");
    return interval_s;
  } catch (const storage::DatabaseError& error) {
    link_->say(error);
  } catch (const std::exception& error) {
    tools_.faults.fault("heartbeat", error.what());
  }
  return std::min(pause_.next_s(), interval_s);
}

void Heartbeat::extend(storage::ResultsDatabase& database, double hold_s) {
  const Clock::time_point seen = Clock::now();
  const std::vector<storage::ClaimedLoop> claims = tools_.progress.proven_claims();
  std::size_t lost = 0;
  for (std::size_t done = 0; done < claims.size(); done += kClaimsAtATime) {
    const auto some =
        std::span(claims).subspan(done, std::min(kClaimsAtATime, claims.size() - done));
    lost += tools_.progress.lose(database.extend(some, hold_s));
  }
  tools_.progress.renewed(seen);
  tools_.metrics.leases_lost(lost);
  if (lost > 0)
    spdlog::warn("{} ended before the work was done: other workers have it now",
                 core::text::counted(lost, "lease", "leases"));
  std::uint64_t lost_so_far = 0;
  {
    const std::lock_guard lock(mutex_);
    lost_leases_ += lost;
    lost_so_far = lost_leases_;
  }
  database.see_worker({process_name(), LOOPSCOPE_VERSION, core::kAlgorithmRevision,
                       tools_.progress.held_loops(), lost_so_far});
}

}  // namespace loopscope::daemon
