#include "daemon/service/threads/in_threads.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace loopscope::daemon {
namespace {

/// What the threads of one call share.
class SharedWork {
 public:
  SharedWork(std::size_t count, const std::function<IndexedTask()>& make_task)
      : count_(count), make_task_(make_task) {}

  void work() {
    try {
      const IndexedTask task = make_task_();
      for (std::size_t index = next_++; index < count_; index = next_++) {
        task(index);
      }
    } catch (...) {
      stop(std::current_exception());
    }
  }

  void throw_failure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void stop(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
    next_ = count_;
  }

  const std::size_t count_;
  const std::function<IndexedTask()>& make_task_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace

void in_threads(std::size_t count, std::size_t threads,
                const std::function<IndexedTask()>& make_task) {
  SharedWork shared(count, make_task);
  {
    std::vector<std::jthread> pool;
    for (std::size_t i = 0; i < std::min(count, threads); ++i) {
      pool.emplace_back([&shared] { shared.work(); });
    }
  }
  shared.throw_failure();
}

}  // namespace loopscope::daemon
