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
#include <random>
#include <spdlog/spdlog.h>
#include <utility>
#include <vector>

#include "config/read_settings.hpp"
#include "daemon/monitor/service_manager.hpp"
#include "daemon/service/heartbeat.hpp"
#include "daemon/service/lane.hpp"
#include "daemon/service/log.hpp"
#include "daemon/service/service_watch.hpp"
#include "daemon/service/storage_settings.hpp"
#include "daemon/service/work_report.hpp"
#include "daemon/service/workforce.hpp"
#include "storage/check_connection.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::chrono::seconds kPulseEvery{1};

/// A lane that found nothing looks again when the next loop falls due or the next lease ends, but
/// after a poll at the latest: other loops may be added. At least a little later, because what is
/// overdue then is in the hands of others right now; and not all lanes of a plant at once.
double idle_pause_s(std::optional<double> next_due_in_s, double poll_s) {
  constexpr double kLeast_s = 0.1;
  thread_local std::minstd_rand random{std::random_device{}()};
  const double wait_s =
      std::clamp(next_due_in_s.value_or(poll_s), std::min(kLeast_s, poll_s), poll_s);
  return std::min(wait_s + std::uniform_real_distribution<double>(0.0, 0.05)(random), poll_s);
}

/// State is touched by the io_context's thread alone; a busy lane belongs to its pool thread
/// until that posts it back.
class Service {
 public:
  explicit Service(std::filesystem::path file)
      : file_(std::move(file)),
        settings_(std::make_shared<config::Settings>(config::read_settings(file_))),
        tools_(worker_count(settings_->daemon), Perseverance::endless),
        signals_(context_, SIGINT, SIGTERM, SIGHUP),
        pulse_timer_(context_),
        pool_(lane_count(settings_->daemon)) {
    set_up_log(settings_->daemon);
    for (std::size_t index = 0; index < lane_count(settings_->daemon); ++index) {
      seats_.emplace_back(context_, settings_->schedule.poll_s);
    }
  }

  void run() {
    spdlog::info("started: {} workers, {} batches in flight, settings {}",
                 worker_count(settings_->daemon), seats_.size(), file_.string());
    tell_sources();
    warn_of_connections();
    heartbeat_.emplace(settings_, tools_);
    watch_.emplace(settings_, tools_, *heartbeat_);
    await_signal();
    pulse();
    for (std::size_t index = 0; index < seats_.size(); ++index) dispatch(index);
    // Until the lanes have said their last words: a second signal is awaited as long.
    context_.run();
    pool_.join();
    watch_.reset();
    heartbeat_.reset();
    spdlog::info("stopped: {}", count_text(sum_));
  }

 private:
  /// A lane and when it looks again.
  struct Seat {
    Seat(asio::io_context& context, double poll_s) : timer(context), pause(poll_s) {}
    std::optional<Lane> lane;
    asio::steady_timer timer;
    RetryPause pause;
  };
  struct Drained {
    storage::WriteCount count;
    bool failed = false;
    std::optional<double> next_due_in_s;
  };

  void await_signal() {
    signals_.async_wait([this](const auto& error, int signal) {
      if (error) return;
      await_signal();
      if (signal == SIGHUP) {
        reload();
      } else if (stopping_) {
        end_at_once(signal);
      } else {
        stop();
      }
    });
  }

  void stop() {
    spdlog::info("stopping: finishing what is in hand");
    stopping_ = true;
    watch_->stopping();
    tools_.bell.ring();
    for (Seat& seat : seats_) seat.timer.cancel();
    end_when_idle();
  }

  /// Leases that are held run out, and others take over.
  [[noreturn]] static void end_at_once(int signal) {
    spdlog::warn("stopped at once by a second signal");
    std::_Exit(128 + signal);
  }

  void end_when_idle() {
    if (!stopping_ || busy_ > 0) return;
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
      settings_ = std::make_shared<config::Settings>(config::read_settings(file_));
      set_up_log(settings_->daemon);
      tools_.historians.forget_idle();
      heartbeat_->use(settings_);
      watch_->use(settings_);
      tell_sources();
      for (Seat& seat : seats_) seat.pause = RetryPause(settings_->schedule.poll_s);
      spdlog::info("settings read again: {}", file_.string());
      tools_.metrics.settings_reload(true);
      ServiceManager::ready("settings read again");
    } catch (const config::SettingsError& error) {
      spdlog::error("the old settings stay in force: {}", error.what());
      tools_.metrics.settings_reload(false);
      ServiceManager::ready("the old settings stay in force: the file has problems");
    }
  }

  /// Sends an idle lane to look for due loops.
  void dispatch(std::size_t index) {
    Seat& seat = seats_[index];
    if (!seat.lane || seat.lane->settings() != settings_) {
      seat.lane.emplace(settings_, index, SlotRule::clock, tools_);
    }
    ++busy_;
    asio::post(pool_, [this, index, &seat] {
      const Drained drained = drain(*seat.lane);
      asio::post(context_, [this, index, drained] { rest(index, drained); });
    });
  }

  /// Back from the pool: until the next look.
  void rest(std::size_t index, const Drained& drained) {
    --busy_;
    add(sum_, drained.count);
    if (stopping_) return end_when_idle();
    Seat& seat = seats_[index];
    if (!drained.failed) seat.pause.reset();
    const double pause_s = drained.failed
                               ? seat.pause.next_s()
                               : idle_pause_s(drained.next_due_in_s, settings_->schedule.poll_s);
    seat.timer.expires_after(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(pause_s)));
    seat.timer.async_wait([this, index](const auto& error) {
      if (!error && !stopping_) dispatch(index);
    });
  }

  /// Works until nothing is due. Runs on a pool thread.
  Drained drain(Lane& lane) {
    Drained drained;
    try {
      WorkReport report(lane.cost());
      for (auto claims = next_claims(lane); !claims.empty(); claims = next_claims(lane)) {
        const storage::WriteCount count = lane.process(claims);
        report.add(count, lane.cost());
        add(drained.count, count);
      }
      lane.store_cost();
      report.say();
      drained.next_due_in_s = lane.next_due_in_s();
      tools_.faults.recovered("worker", &lane);
    } catch (const storage::DatabaseError& error) {
      drained.failed = true;
      lane.say(error);
    } catch (const std::exception& error) {
      drained.failed = true;
      tools_.faults.fault("worker", error.what(), &lane);
    }
    return drained;
  }

  std::vector<storage::ClaimedLoop> next_claims(Lane& lane) {
    if (stopping_) return {};
    auto claims = lane.claim_due();
    return claims.empty() ? lane.claim_suspect() : claims;
  }

  std::filesystem::path file_;
  std::shared_ptr<const config::Settings> settings_;
  LaneTools tools_;
  asio::io_context context_;
  asio::signal_set signals_;
  asio::steady_timer pulse_timer_;
  std::deque<Seat> seats_;
  std::size_t busy_ = 0;  ///< lanes on the pool
  asio::thread_pool pool_;
  std::atomic<bool> stopping_ = false;
  std::optional<Heartbeat> heartbeat_;
  std::optional<ServiceWatch> watch_;
  storage::WriteCount sum_;
};

}  // namespace

void run_service(const std::filesystem::path& settings_file) {
  Service(settings_file).run();
}

}  // namespace loopscope::daemon
