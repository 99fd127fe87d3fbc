#include "daemon/service/pass.hpp"

#include <asio/io_context.hpp>
#include <asio/post.hpp>
#include <asio/signal_set.hpp>
#include <asio/thread_pool.hpp>
#include <atomic>
#include <csignal>
#include <exception>
#include <mutex>
#include <utility>
#include <vector>

#include "daemon/service/analysis_worker.hpp"
#include "daemon/service/heartbeat.hpp"
#include "daemon/service/observe/stage_timings.hpp"
#include "daemon/service/observe/work_report.hpp"
#include "daemon/service/progress_bar.hpp"
#include "daemon/service/shared/compare_clocks.hpp"
#include "daemon/service/threads/worker_identity.hpp"

namespace loopscope::daemon {
namespace {

/// Workers run on a thread pool; everything that is shared (bar, sum, end) is touched by the main
/// thread's io_context alone.
class Pass {
 public:
  Pass(std::shared_ptr<const config::Settings> settings, SharedServices& tools,
       std::stop_source stop)
      : settings_(std::move(settings)),
        tools_(tools),
        stop_(std::move(stop)),
        signals_(context_, SIGINT, SIGTERM),
        workers_left_(worker_count(settings_->daemon)),
        walking_workers_(workers_left_),
        pool_(workers_left_) {}

  PassResult run() {
    ResultsLink results(settings_, tools_.faults, tools_.metrics, tools_.clocks, tools_.stop,
                        tools_.watermarks);
    if (const auto refusal = compare_clocks(*settings_, tools_, results)) throw *refusal;
    result_.enabled = results.with(
        [](storage::ResultsDatabase& database) { return database.count_enabled_loops(); });
    const Heartbeat heartbeat(settings_, tools_);
    ProgressBar bar(result_.enabled);
    bar_ = &bar;
    signals_.async_wait([this](const auto& error, int signal) {
      if (error) return;
      stop_.request_stop();
      result_.signal = signal;
    });
    Stopwatch watch;
    for (std::size_t index = 0; index < workers_left_; ++index) {
      asio::post(pool_, [this, index] { work(index); });
    }
    context_.run();
    pool_.join();
    // After a signal the context may have run out of work before the workers' last words.
    context_.restart();
    context_.run();
    if (error_) std::rethrow_exception(error_);
    result_.elapsed_s = watch.lap_s();
    return result_;
  }

 private:
  void work(std::size_t index) {
    try {
      AnalysisWorker worker(settings_, index, SlotRule::newest_sample, tools_);
      process_all(worker, [&] { return next_claims(worker); });
      // The last worker, so that a suspect which kills the process takes nothing with it.
      if (--walking_workers_ == 0) process_all(worker, [&] { return next_suspect(worker); });
      worker.store_cost();
      asio::post(context_, [this, failure = worker.first_failure(), cost = worker.cost()] {
        if (!result_.first_failure) result_.first_failure = failure;
        storage::add(result_.cost, cost);
      });
    } catch (...) {
      failed_ = true;
      asio::post(context_, [this, error = std::current_exception()] {
        if (!error_) error_ = error;
      });
    }
    asio::post(context_, [this] {
      if (--workers_left_ == 0) signals_.cancel();
    });
  }

  [[nodiscard]] bool claims_have_ended() const { return failed_ || stop_.stop_requested(); }

  /// Until there is nothing to claim.
  template <typename Claim>
  void process_all(AnalysisWorker& worker, Claim claim) {
    for (auto claims = claim(); !claims.empty(); claims = claim()) {
      const storage::WriteCount count = worker.process(claims);
      asio::post(context_, [this, count, loops = claims.size()] { account(count, loops); });
    }
  }

  /// Each at most once, since one that is done is none any more. Those that rest are left out: they
  /// have killed a process that had nothing else in hand.
  std::vector<storage::ClaimedLoop> next_suspect(AnalysisWorker& worker) {
    if (claims_have_ended()) return {};
    return worker.claim_suspect();
  }

  /// Claims are taken one worker at a time, so that all walk through the catalogue together.
  std::vector<storage::ClaimedLoop> next_claims(AnalysisWorker& worker) {
    const std::lock_guard lock(cursor_mutex_);
    if (claims_have_ended()) return {};
    auto claims = worker.claim_next(cursor_);
    for (const storage::ClaimedLoop& claim : claims) {
      cursor_ = std::max(cursor_, claim.loop.loop_id);
    }
    return claims;
  }

  void account(const storage::WriteCount& count, std::size_t loops) {
    add(result_.count, count);
    result_.loops += loops;
    bar_->advance(loops);
  }

  std::shared_ptr<const config::Settings> settings_;
  SharedServices& tools_;
  std::stop_source stop_;
  asio::io_context context_;
  asio::signal_set signals_;
  std::size_t workers_left_;
  std::atomic<std::size_t> walking_workers_;  ///< that may still find a batch
  asio::thread_pool pool_;
  std::mutex cursor_mutex_;
  std::int64_t cursor_ = 0;
  /// A worker has. No stop: what the others have in hand is tried again as long as ever.
  std::atomic<bool> failed_ = false;
  PassResult result_;
  std::exception_ptr error_;
  ProgressBar* bar_ = nullptr;
};

}  // namespace

PassResult run_pass(const std::shared_ptr<const config::Settings>& settings, SharedServices& tools,
                    std::stop_source stop) {
  return Pass(settings, tools, std::move(stop)).run();
}

}  // namespace loopscope::daemon
