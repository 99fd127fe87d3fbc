#include "daemon/service/pass.hpp"

#include <asio/io_context.hpp>
#include <asio/post.hpp>
#include <asio/signal_set.hpp>
#include <asio/thread_pool.hpp>
#include <atomic>
#include <csignal>
#include <exception>
#include <mutex>
#include <vector>

#include "daemon/service/progress_bar.hpp"
#include "daemon/service/worker.hpp"
#include "daemon/service/workforce.hpp"

namespace loopscope::daemon {
namespace {

/// Workers run on a thread pool; everything that is shared (bar, sum, end) is touched by the main
/// thread's io_context alone.
class Pass {
 public:
  explicit Pass(std::shared_ptr<const config::Settings> settings)
      : settings_(std::move(settings)),
        signals_(context_, SIGINT, SIGTERM),
        workers_left_(worker_count(settings_->daemon)),
        pool_(workers_left_) {}

  PassResult run() {
    Worker scout(settings_, worker_name(0), SlotRule::newest_sample, faults_, historians_);
    result_.enabled = scout.with_results(
        [](storage::ResultsDatabase& database) { return database.count_enabled_loops(); });
    ProgressBar bar(result_.enabled);
    bar_ = &bar;
    signals_.async_wait([this](const auto& error, int signal) {
      if (error) return;
      stopping_ = true;
      result_.signal = signal;
    });
    for (std::size_t index = 0; index < workers_left_; ++index) {
      asio::post(pool_, [this, index] { work(index); });
    }
    context_.run();
    pool_.join();
    // After a signal the context may have run out of work before the workers' last words.
    context_.restart();
    context_.run();
    if (error_) std::rethrow_exception(error_);
    return result_;
  }

 private:
  void work(std::size_t index) {
    try {
      Worker worker(settings_, worker_name(index), SlotRule::newest_sample, faults_, historians_);
      for (auto claims = next_claims(worker); !claims.empty(); claims = next_claims(worker)) {
        const storage::WriteCount count = worker.process(claims);
        asio::post(context_, [this, count, loops = claims.size()] { account(count, loops); });
      }
      asio::post(context_, [this, failure = worker.first_failure()] {
        if (!result_.first_failure) result_.first_failure = failure;
      });
    } catch (...) {
      stopping_ = true;
      asio::post(context_, [this, error = std::current_exception()] {
        if (!error_) error_ = error;
      });
    }
    asio::post(context_, [this] {
      if (--workers_left_ == 0) signals_.cancel();
    });
  }

  /// Claims are taken one worker at a time, so that all walk through the catalogue together.
  std::vector<storage::ClaimedLoop> next_claims(Worker& worker) {
    const std::lock_guard lock(cursor_mutex_);
    if (stopping_) return {};
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
  FaultLog faults_;
  HistorianPool historians_;
  asio::io_context context_;
  asio::signal_set signals_;
  std::size_t workers_left_;
  asio::thread_pool pool_;
  std::mutex cursor_mutex_;
  std::int64_t cursor_ = 0;
  std::atomic<bool> stopping_ = false;
  PassResult result_;
  std::exception_ptr error_;
  ProgressBar* bar_ = nullptr;
};

}  // namespace

PassResult run_pass(const std::shared_ptr<const config::Settings>& settings) {
  return Pass(settings).run();
}

}  // namespace loopscope::daemon
