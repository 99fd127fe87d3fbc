#include "daemon/service/service_watch.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <utility>

#include "core/text/counted.hpp"
#include "daemon/monitor/monitor_pages.hpp"
#include "daemon/monitor/service_manager.hpp"
#include "daemon/service/shared/compare_clocks.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

using std::chrono::duration;

/// The scheduling thread never waits for anything.
constexpr double kPulseLimit_s = 30.0;
/// A worker or the heartbeat waits for databases, but no longer than a lease
/// (storage_settings.cpp); a short lease is no reason to restart a process that is connecting.
constexpr double kLeastLimit_s = 60.0;
/// No statement takes longer than a minute and no analysis nearly as long, whatever the lease.
constexpr double kMostLimit_s = 300.0;
/// What systemd is asked for while the last batches are finished, in all 90 s.
constexpr std::chrono::seconds kStoppingPatience{30};
constexpr std::chrono::seconds kLongestStopping{60};

/// Whoever announces flags looks no oftener by itself; asking costs 0.1 s of the server's time for
/// 10 000 loops (storage/MEASURED.md).
constexpr std::chrono::seconds kBetweenPlantFigures{60};

HealthLimits limits(const config::Settings& settings) {
  // Three polls without an answer.
  return {std::max(kLeastLimit_s, 3.0 * settings.schedule.poll_s), settings.daemon.max_lag_s};
}

double seconds(duration<double> time) {
  return time.count();
}

/// SQLSTATE classes: no such schema or another version of it; an object of it is missing or
/// changed.
bool is_schema_error(const storage::DatabaseError& error) {
  return error.sqlstate().starts_with("3F") || error.sqlstate().starts_with("42");
}

}  // namespace

ServiceWatch::ServiceWatch(std::shared_ptr<const config::Settings> settings, SharedServices& tools,
                           Heartbeat& heartbeat)
    : tools_(tools),
      heartbeat_(heartbeat),
      settings_(std::move(settings)),
      health_([this] { return why_not_live(); }, limits(*settings_)),
      pages_([this] { return this->settings(); }, [&tools] { return tools.comparing.load(); }),
      reports_(settings_, tools.faults) {
  open_pages();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  ServiceManager::ready("waiting for the results database");
}

ServiceWatch::~ServiceWatch() {
  if (server_) server_->stop();
}

void ServiceWatch::open_pages() {
  // The settings were checked: what is left without an address wants no server.
  const auto address = config::parse_http_address(settings_->daemon.http_address);
  if (!address) return;
  try {
    server_.emplace(*address, settings_->daemon.http_names);
    add_monitor_pages(*server_, health_, tools_.metrics, [this] { return silence_s(); });
    pages_.add_to(*server_);
    server_->start();
    const std::string& asked = settings_->daemon.http_address;
    spdlog::info("health, metrics and pages: http://{}:{}", asked.substr(0, asked.rfind(':')),
                 server_->port());
    if (const auto& acknowledge = settings_->daemon.acknowledge; acknowledge.on())
      spdlog::info("people acknowledge on the pages: signed in by {}, seen under {}",
                   fmt::join(acknowledge.trusted_proxies, ", "), acknowledge.origin);
  } catch (const Failure& failure) {
    server_.reset();
    tools_.faults.fault("http", std::string(failure.what()) + " HINT: " + failure.hint());
  }
}

void ServiceWatch::use(std::shared_ptr<const config::Settings> settings) {
  const std::lock_guard lock(mutex_);
  health_.set_limits(limits(*settings));
  reports_.use(settings);
  if (server_) server_->use_names(settings->daemon.http_names);
  settings_ = std::move(settings);
  changed_.notify_all();
}

std::shared_ptr<const config::Settings> ServiceWatch::settings() {
  const std::lock_guard lock(mutex_);
  return settings_;
}

void ServiceWatch::pulse() {
  {
    const std::lock_guard lock(mutex_);
    pulsed_at_ = Clock::now();
  }
  if (!health_.live().well) return;
  ServiceManager::feed_watchdog();
  if (tools_.stop.stop_requested() && Clock::now() - stopping_since_ < kLongestStopping)
    ServiceManager::extend_timeout(kStoppingPatience);
}

void ServiceWatch::stopping() {
  stopping_since_ = Clock::now();
  ServiceManager::stopping("finishing what is in hand");
}

std::optional<std::string> ServiceWatch::why_not_live() {
  const double limit_s = std::clamp(settings()->schedule.lease_s, kLeastLimit_s, kMostLimit_s);
  Clock::time_point pulsed_at;
  {
    const std::lock_guard lock(mutex_);
    pulsed_at = pulsed_at_;
  }
  const double pulse_s = seconds(Clock::now() - pulsed_at);
  if (pulse_s > kPulseLimit_s)
    return fmt::format("the scheduler has stood still for {:.0f} s", pulse_s);
  const double beat_s = seconds(heartbeat_.silence());
  if (beat_s > limit_s) return fmt::format("the heartbeat has stood still for {:.0f} s", beat_s);
  return tools_.progress.standstill(
      std::chrono::duration_cast<Clock::duration>(duration<double>(limit_s)));
}

double ServiceWatch::silence_s() {
  const std::lock_guard lock(mutex_);
  return seconds(std::max(
      {tools_.progress.longest_silence(), heartbeat_.silence(), Clock::now() - pulsed_at_}));
}

void ServiceWatch::run(const std::stop_token& stop) {
  std::shared_ptr<const config::Settings> linked_with;
  std::optional<ResultsLink> link;
  while (!stop.stop_requested()) {
    const auto now_in_force = settings();
    if (linked_with != now_in_force) {
      linked_with = now_in_force;
      link.emplace(linked_with, tools_.faults, tools_.metrics, tools_.clocks, tools_.stop,
                   tools_.watermarks);
    }
    look(*link, *linked_with);
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, stop, duration<double>(linked_with->schedule.poll_s),
                      [&] { return settings_ != linked_with; });
  }
}

void ServiceWatch::look(ResultsLink& link, const config::Settings& settings) {
  try {
    const auto refusal = compare_clocks(settings, tools_, link);
    health_.set_clock_refusal(refusal ? std::optional<std::string>(refusal->what()) : std::nullopt);
    const storage::ScheduleHealth schedule = link.with([this](storage::ResultsDatabase& database) {
      database.look_back();
      if (const auto away = tools_.sources_away(); !away.empty()) database.look_back(away);
      return database.schedule_health();
    });
    tools_.metrics.set(schedule, settings.results.retention_months);
    health_.results_answered();
    health_.set(schedule);
    tools_.faults.recovered("monitor");
    if (!refusal) recall_stray(link, settings.schedule.settle_s);
    look_at_plant(link);
    if (tools_.stop.stop_requested()) return;
    ServiceManager::status(fmt::format("{}, {} overdue by {:.0f} s at most, {} failing",
                                       core::text::counted(schedule.enabled_loops, "loop", "loops"),
                                       schedule.overdue_loops, schedule.lag_s,
                                       schedule.failing_loops));
  } catch (const storage::DatabaseError& error) {
    link.say(error);
    if (is_schema_error(error)) health_.schema_refused(error.what());
    if (!tools_.stop.stop_requested())
      ServiceManager::status("the results database is not reachable");
  } catch (const std::exception& error) {
    tools_.faults.fault("monitor", error.what());
  }
}

void ServiceWatch::look_at_plant(ResultsLink& link) {
  const Clock::time_point now = Clock::now();
  if (plant_seen_ && now - *plant_seen_ < kBetweenPlantFigures) return;
  plant_seen_ = now;  // also where it fails: what is dear is not asked for at every poll
  tools_.metrics.set(
      link.with([](storage::ResultsDatabase& database) { return database.plant_figures(); }));
}

void ServiceWatch::recall_stray(ResultsLink& link, double settle_s) {
  const std::size_t count = link.with(
      [&](storage::ResultsDatabase& database) { return database.recall_stray(settle_s); });
  if (count > 0)
    spdlog::warn(
        "{} put off beyond the period, or with windows in the future, go on now: the clock of the "
        "results database was ahead, or a period has become shorter",
        core::text::counted(count, "loop", "loops"));
}

}  // namespace loopscope::daemon
