#include "daemon/service/service.hpp"

#include <asio/io_context.hpp>
#include <asio/post.hpp>
#include <asio/signal_set.hpp>
#include <asio/steady_timer.hpp>
#include <asio/thread_pool.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>
#include <spdlog/spdlog.h>
#include <vector>

#include "config/read_settings.hpp"
#include "daemon/service/lane.hpp"
#include "daemon/service/log.hpp"
#include "daemon/service/work_report.hpp"
#include "daemon/service/workforce.hpp"

namespace loopscope::daemon {
namespace {

/// State is touched by the io_context's thread alone; a busy lane belongs to its pool thread
/// until that posts it back.
class Service {
 public:
  explicit Service(std::filesystem::path file)
      : file_(std::move(file)),
        settings_(std::make_shared<config::Settings>(config::read_settings(file_))),
        tools_(worker_count(settings_->daemon)),
        signals_(context_, SIGINT, SIGTERM, SIGHUP),
        timer_(context_),
        seats_(lane_count(settings_->daemon)),
        pool_(seats_.size()) {
    set_up_log(settings_->daemon);
  }

  void run() {
    spdlog::info("started: {} workers, {} batches in flight, settings {}",
                 worker_count(settings_->daemon), seats_.size(), file_.string());
    await_signal();
    tick();
    context_.run();
    pool_.join();
    // After a signal the context may have run out of work before the lanes' last words.
    context_.restart();
    context_.run();
    spdlog::info("stopped: {}", count_text(sum_));
  }

 private:
  struct Seat {
    std::optional<Lane> lane;
    bool busy = false;
  };

  void await_signal() {
    signals_.async_wait([this](const auto& error, int signal) {
      if (error) return;
      if (signal == SIGHUP) {
        reload();
        await_signal();
      } else {
        stop();
      }
    });
  }

  void stop() {
    spdlog::info("stopping: finishing what is in hand");
    stopping_ = true;
    timer_.cancel();
  }

  void reload() {
    try {
      settings_ = std::make_shared<config::Settings>(config::read_settings(file_));
      set_up_log(settings_->daemon);
      tools_.historians.forget_idle();
      spdlog::info("settings read again: {}", file_.string());
    } catch (const config::SettingsError& error) {
      spdlog::error("the old settings stay in force: {}", error.what());
    }
  }

  /// Sends every idle lane to look for due loops, now and after each poll.
  void tick() {
    if (stopping_) return;
    for (std::size_t index = 0; index < seats_.size(); ++index) {
      if (!seats_[index].busy) dispatch(index);
    }
    timer_.expires_after(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(settings_->schedule.poll_s)));
    timer_.async_wait([this](const auto& error) {
      if (!error) tick();
    });
  }

  void dispatch(std::size_t index) {
    Seat& seat = seats_[index];
    if (!seat.lane || seat.lane->settings() != settings_) {
      seat.lane.emplace(settings_, index, SlotRule::clock, tools_);
    }
    seat.busy = true;
    asio::post(pool_, [this, &seat] {
      const storage::WriteCount count = drain(*seat.lane);
      asio::post(context_, [this, &seat, count] {
        seat.busy = false;
        add(sum_, count);
      });
    });
  }

  /// Works until nothing is due. Runs on a pool thread.
  storage::WriteCount drain(Lane& lane) {
    storage::WriteCount sum;
    try {
      WorkReport report(lane.cost());
      for (auto claims = next_claims(lane); !claims.empty(); claims = next_claims(lane)) {
        const storage::WriteCount count = lane.process(claims);
        report.add(count, lane.cost());
        add(sum, count);
      }
      lane.store_cost();
      report.say();
      tools_.faults.recovered("results database");
    } catch (const storage::DatabaseError& error) {
      tools_.faults.fault("results database", std::string(error.what()) + " HINT: " + error.hint());
    } catch (const std::exception& error) {
      tools_.faults.fault("worker", error.what());
    }
    return sum;
  }

  std::vector<storage::ClaimedLoop> next_claims(Lane& lane) {
    return stopping_ ? std::vector<storage::ClaimedLoop>{} : lane.claim_due();
  }

  std::filesystem::path file_;
  std::shared_ptr<const config::Settings> settings_;
  LaneTools tools_;
  asio::io_context context_;
  asio::signal_set signals_;
  asio::steady_timer timer_;
  std::vector<Seat> seats_;
  asio::thread_pool pool_;
  std::atomic<bool> stopping_ = false;
  storage::WriteCount sum_;
};

}  // namespace

void run_service(const std::filesystem::path& settings_file) {
  Service(settings_file).run();
}

}  // namespace loopscope::daemon
