#include "daemon/service/pass.hpp"

#include <algorithm>
#include <asio/io_context.hpp>
#include <asio/post.hpp>
#include <asio/signal_set.hpp>
#include <asio/thread_pool.hpp>
#include <atomic>
#include <csignal>
#include <exception>
#include <mutex>
#include <utility>

#include "daemon/service/heartbeat.hpp"
#include "daemon/service/observe/stage_timings.hpp"
#include "daemon/service/observe/work_report.hpp"
#include "daemon/service/progress_bar.hpp"
#include "daemon/service/shared/compare_clocks.hpp"
#include "daemon/service/threads/worker_identity.hpp"

namespace loopscope::daemon {
namespace {

using storage::ClaimedLoop;

/// Workers run on a thread pool; everything that is shared (bar, sum, end) is touched by the main
/// thread's io_context alone.
class Pass {
 public:
  Pass(std::shared_ptr<const config::Settings> settings, SharedServices& tools,
       std::stop_source stop, const PassPlan& plan)
      : settings_(std::move(settings)),
        tools_(tools),
        stop_(std::move(stop)),
        source_(plan.source),
        bar_(plan.total, plan.unit),
        signals_(context_, SIGINT, SIGTERM),
        workers_left_(plan.workers),
        pool_(plan.workers) {}

  PassResult run() {
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
      process_all(worker);
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
  void process_all(AnalysisWorker& worker) {
    while (!claims_have_ended()) {
      const std::vector<ClaimedLoop> claims = source_.next(worker);
      if (claims.empty()) break;
      const storage::WriteCount count = worker.process(claims);
      source_.done(claims, count);
      asio::post(context_, [this, count, loops = claims.size()] { account(count, loops); });
    }
    asio::post(context_, [this] { advance(); });
  }

  void account(const storage::WriteCount& count, std::size_t loops) {
    add(result_.count, count);
    result_.loops += loops;
    advance();
  }

  void advance() {
    const std::size_t settled = source_.settled();
    bar_.advance(settled - std::exchange(shown_, settled));
  }

  std::shared_ptr<const config::Settings> settings_;
  SharedServices& tools_;
  std::stop_source stop_;
  ClaimSource& source_;
  ProgressBar bar_;
  std::size_t shown_ = 0;
  asio::io_context context_;
  asio::signal_set signals_;
  std::size_t workers_left_;
  asio::thread_pool pool_;
  /// A worker has. No stop: what the others have in hand is tried again as long as ever.
  std::atomic<bool> failed_ = false;
  PassResult result_;
  std::exception_ptr error_;
};

/// The catalogue from its first loop to its last one, then the suspects: so that one which kills
/// the process takes nothing with it.
class CatalogueWalk : public ClaimSource {
 public:
  CatalogueWalk(std::size_t workers, std::size_t enabled)
      : walking_workers_(workers), left_(enabled) {}

  std::vector<ClaimedLoop> next(AnalysisWorker& worker) override {
    if (last_worker_ == &worker) return next_suspect(worker);
    std::vector<ClaimedLoop> claims = next_claims(worker);
    // The last worker, which no other one's work waits for.
    if (!claims.empty() || --walking_workers_ > 0) return claims;
    last_worker_ = &worker;
    return next_suspect(worker);
  }

  void done(const std::vector<ClaimedLoop>& claims, const storage::WriteCount& /*count*/) override {
    settled_ += claims.size();
  }

  [[nodiscard]] std::size_t settled() const override { return settled_; }

 private:
  /// Each at most once, since one that is done is none any more. Those that rest are left out: they
  /// have killed a process that had nothing else in hand.
  static std::vector<ClaimedLoop> next_suspect(AnalysisWorker& worker) {
    return worker.claim_suspect();
  }

  /// Claims are taken one worker at a time, so that all walk through the catalogue together.
  std::vector<ClaimedLoop> next_claims(AnalysisWorker& worker) {
    const std::lock_guard lock(mutex_);
    auto claims = worker.claim_next(cursor_, left_);
    left_ -= std::min(left_, claims.size());
    for (const ClaimedLoop& claim : claims) cursor_ = std::max(cursor_, claim.loop.loop_id);
    return claims;
  }

  std::atomic<std::size_t> walking_workers_;  ///< that may still find a batch
  std::atomic<AnalysisWorker*> last_worker_ = nullptr;
  std::atomic<std::size_t> settled_ = 0;
  std::mutex mutex_;
  std::int64_t cursor_ = 0;
  std::size_t left_;  ///< of the loops, as many as were enabled at first
};

}  // namespace

PassResult run_workers(const std::shared_ptr<const config::Settings>& settings,
                       SharedServices& tools, std::stop_source stop, const PassPlan& plan) {
  return Pass(settings, tools, std::move(stop), plan).run();
}

PassResult run_pass(const std::shared_ptr<const config::Settings>& settings, SharedServices& tools,
                    std::stop_source stop) {
  ResultsLink results(settings, tools.faults, tools.metrics, tools.clocks, tools.stop,
                      tools.watermarks);
  if (const auto refusal = compare_clocks(*settings, tools, results)) throw *refusal;
  const std::size_t enabled = results.with(
      [](storage::ResultsDatabase& database) { return database.count_enabled_loops(); });
  const Heartbeat heartbeat(settings, tools);
  const std::size_t workers = worker_count(settings->daemon);
  CatalogueWalk walk(workers, enabled);
  PassResult result = run_workers(settings, tools, std::move(stop), {walk, workers, enabled});
  result.enabled = enabled;
  return result;
}

}  // namespace loopscope::daemon
