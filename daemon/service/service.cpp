#include "daemon/service/service.hpp"

#include <algorithm>
#include <asio/io_context.hpp>
#include <asio/post.hpp>
#include <asio/signal_set.hpp>
#include <asio/steady_timer.hpp>
#include <asio/thread_pool.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <optional>
#include <spdlog/spdlog.h>
#include <stop_token>
#include <utility>
#include <vector>

#include "config/read_settings.hpp"
#include "core/text/counted.hpp"
#include "daemon/monitor/service_manager.hpp"
#include "daemon/plant/plant_watch.hpp"
#include "daemon/service/analysis_worker.hpp"
#include "daemon/service/heartbeat.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/observe/log.hpp"
#include "daemon/service/observe/work_report.hpp"
#include "daemon/service/service_watch.hpp"
#include "daemon/service/threads/pauses.hpp"
#include "daemon/service/threads/worker_identity.hpp"
#include "storage/check_connection.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::chrono::seconds kPulseEvery{1};
/// One in so many of a worker's looks in a row begins with the suspects.
constexpr int kSuspectEvery = 16;

/// State is touched by the io_context's thread alone; a busy worker belongs to its pool thread
/// until that posts it back.
class Service {
 public:
  explicit Service(std::filesystem::path file)
      : file_(std::move(file)),
        settings_(std::make_shared<config::Settings>(config::read_settings(file_))),
        tools_(core_count(settings_->daemon), RetryLimit::endless, stop_.get_token()),
        signals_(context_, SIGINT, SIGTERM, SIGHUP),
        pulse_timer_(context_),
        pool_(worker_count(settings_->daemon)),
        in_force_(settings_.get()) {
    set_up_log(settings_->daemon);
    tools_.windows.limit(settings_->daemon.cache_bytes());
    for (std::size_t index = 0; index < worker_count(settings_->daemon); ++index) {
      workers_.emplace_back(context_, settings_->schedule.poll_s);
    }
  }

  void run() {
    spdlog::info(
        "started: {} on {}, settings {}", core::text::counted(workers_.size(), "worker", "workers"),
        core::text::counted(core_count(settings_->daemon), "core", "cores"), file_.string());
    tell_sources();
    warn_of_connections();
    heartbeat_.emplace(settings_, tools_);
    watch_.emplace(settings_, tools_, *heartbeat_);
    plant_.emplace(settings_, tools_);
    await_signal();
    pulse();
    for (std::size_t index = 0; index < workers_.size(); ++index) dispatch(index);
    // Until the workers have said their last words: a second signal is awaited as long.
    context_.run();
    pool_.join();
    plant_.reset();
    watch_.reset();
    heartbeat_.reset();
    spdlog::info("stopped: {}", count_text(sum_));
  }

 private:
  /// A worker and when it looks again.
  struct ScheduledWorker {
    ScheduledWorker(asio::io_context& context, double poll_s) : timer(context), pause(poll_s) {}
    std::optional<AnalysisWorker> worker;
    asio::steady_timer timer;
    RetryPause pause;
  };
  struct DrainResult : Look {
    storage::WriteCount count;
  };

  void await_signal() {
    signals_.async_wait([this](const auto& error, int signal) {
      if (error) return;
      await_signal();
      if (signal == SIGHUP) {
        reload();
      } else if (stop_.stop_requested()) {
        end_at_once(signal);
      } else {
        stop();
      }
    });
  }

  void stop() {
    spdlog::info("stopping: finishing what is in hand");
    stop_.request_stop();
    watch_->stopping();
    for (ScheduledWorker& scheduled : workers_) scheduled.timer.cancel();
    end_when_idle();
  }

  /// Leases that are held run out, and others take over.
  [[noreturn]] static void end_at_once(int signal) {
    spdlog::warn("stopped at once by a second signal");
    std::_Exit(128 + signal);
  }

  void end_when_idle() {
    if (!stop_.stop_requested() || busy_ > 0) return;
    signals_.cancel();
    pulse_timer_.cancel();
  }

  void pulse() {
    watch_->pulse();
    pulse_timer_.expires_after(kPulseEvery);
    pulse_timer_.async_wait([this](const auto& error) {
      if (!error) pulse();
    });
  }

  void tell_sources() {
    std::vector<std::string> sources;
    for (const auto& historian : settings_->historians) sources.push_back(historian.name);
    tools_.metrics.set_sources(sources);
    tools_.clocks.keep_historians(sources);
  }

  /// What leaves the machine unprotected, or passwords that are ignored or shown.
  void warn_of_connections() {
    std::vector<storage::ConnectionSettings> connections{results_connection(*settings_)};
    for (const auto& historian : settings_->historians) {
      connections.push_back(historian_connection(historian));
    }
    for (const storage::ConnectionSettings& connection : connections) {
      for (const storage::Finding& finding : check_connection(connection)) {
        spdlog::warn("{} HINT: {}", finding.what, finding.hint);
      }
    }
  }

  void reload() {
    ServiceManager::reloading();
    try {
      const auto before = std::exchange(
          settings_, std::make_shared<config::Settings>(config::read_settings(file_)));
      in_force_ = settings_.get();
      set_up_log(settings_->daemon);
      tools_.windows.limit(settings_->daemon.cache_bytes());
      tools_.historians.forget_idle();
      heartbeat_->use(settings_);
      watch_->use(settings_);
      plant_->use(settings_);
      tell_sources();
      for (ScheduledWorker& scheduled : workers_)
        scheduled.pause = RetryPause(settings_->schedule.poll_s);
      forget_faults_of_former(before->historians);
      spdlog::info("settings read again: {}", file_.string());
      if (wants_restart(before->daemon))
        spdlog::warn("workers, batches_in_flight and http_address change with a restart only");
      tools_.metrics.settings_reload(true);
      ServiceManager::ready("settings read again");
    } catch (const config::SettingsError& error) {
      spdlog::error("the old settings stay in force: {}", error.what());
      tools_.metrics.settings_reload(false);
      ServiceManager::ready("the old settings stay in force: the file has problems");
    }
  }

  void forget_faults_of_former(const std::vector<config::HistorianSettings>& former) {
    for (const config::HistorianSettings& historian : former) {
      if (std::ranges::find(settings_->historians, historian.name,
                            &config::HistorianSettings::name) != settings_->historians.end())
        continue;
      tools_.faults.leave("historian " + historian.name);
      tools_.faults.leave("clock of historian " + historian.name);
    }
  }

  [[nodiscard]] bool wants_restart(const config::DaemonSettings& before) const {
    const config::DaemonSettings& now = settings_->daemon;
    return before.workers != now.workers || before.batches_in_flight != now.batches_in_flight ||
           before.http_address != now.http_address;
  }

  /// Sends an idle worker to look for due loops.
  void dispatch(std::size_t index) {
    ScheduledWorker& scheduled = workers_[index];
    if (!scheduled.worker || scheduled.worker->settings() != settings_) {
      scheduled.worker.emplace(settings_, index, SlotRule::clock, tools_);
    }
    ++busy_;
    asio::post(pool_, [this, index, &scheduled] {
      const DrainResult drained = drain(*scheduled.worker);
      asio::post(context_, [this, index, drained] { rest(index, drained); });
    });
  }

  /// Back from the pool: until the next look.
  void rest(std::size_t index, const DrainResult& drained) {
    --busy_;
    add(sum_, drained.count);
    if (stop_.stop_requested()) return end_when_idle();
    ScheduledWorker& scheduled = workers_[index];
    if (scheduled.worker->settings() != settings_) return dispatch(index);
    scheduled.timer.expires_after(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(idle_pause_s(drained, settings_->schedule.poll_s,
                                                   source_opens_in_s(), scheduled.pause))));
    scheduled.timer.async_wait([this, index](const auto& error) {
      if (!error && !stop_.stop_requested()) dispatch(index);
    });
  }

  /// Of sources that are away; one that somebody tries just now has no time yet.
  std::optional<double> source_opens_in_s() {
    std::optional<double> first_s;
    for (const auto& [source, left] : tools_.historians.closed()) {
      const double left_s = std::chrono::duration<double>(left).count();
      if (left_s > 0.0) first_s = std::min(first_s.value_or(left_s), left_s);
    }
    return first_s;
  }

  /// Works until nothing is due. Runs on a pool thread.
  DrainResult drain(AnalysisWorker& worker) {
    DrainResult drained;
    try {
      WorkReport report(worker.cost());
      for (int round = 1; worker.settings().get() == in_force_; ++round) {
        const auto claims = next_claims(worker, round);
        if (claims.empty()) break;
        const storage::WriteCount count = worker.process(claims);
        drained.worked = true;
        report.add(count, worker.cost());
        add(drained.count, count);
      }
      worker.store_cost();
      report.say();
      drained.next_due_in_s =
          std::max(worker.next_due_in_s().value_or(worker.settings()->schedule.poll_s), 0.0);
      tools_.faults.recovered("worker", &worker);
    } catch (const storage::DatabaseError& error) {
      drained.failed = true;
      worker.say(error);
    } catch (const std::exception& error) {
      drained.failed = true;
      tools_.faults.fault("worker", error.what(), &worker);
    }
    return drained;
  }

  /// Suspects come after all others, but not never.
  std::vector<storage::ClaimedLoop> next_claims(AnalysisWorker& worker, int round) {
    if (stop_.stop_requested()) return {};
    const bool suspect_first = round % kSuspectEvery == 0;
    auto claims = suspect_first ? worker.claim_suspect() : worker.claim_due();
    if (!claims.empty()) return claims;
    return suspect_first ? worker.claim_due() : worker.claim_suspect();
  }

  std::filesystem::path file_;
  std::shared_ptr<const config::Settings> settings_;
  std::stop_source stop_;  ///< requested by the first SIGTERM or SIGINT
  SharedServices tools_;
  asio::io_context context_;
  asio::signal_set signals_;
  asio::steady_timer pulse_timer_;
  std::deque<ScheduledWorker> workers_;
  std::size_t busy_ = 0;  ///< workers on the pool
  asio::thread_pool pool_;
  std::atomic<const config::Settings*> in_force_;  ///< settings_, for workers at work to compare
  std::optional<Heartbeat> heartbeat_;
  std::optional<ServiceWatch> watch_;
  std::optional<PlantWatch> plant_;
  storage::WriteCount sum_;
};

}  // namespace

void run_service(const std::filesystem::path& settings_file) {
  Service(settings_file).run();
}

}  // namespace loopscope::daemon
