#include "daemon/monitor/connection_queue.hpp"

#include <utility>

namespace loopscope::daemon {

ConnectionQueue::ConnectionQueue(std::size_t threads, std::size_t most_waiting)
    : most_waiting_(most_waiting) {
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

void ConnectionQueue::push(Serve serve) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return queue_.size() < most_waiting_ || closing_; });
  queue_.push_back(std::move(serve));
  waiting_ = queue_.size();
  changed_.notify_all();
}

void ConnectionQueue::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return !queue_.empty() || closing_; });
    if (queue_.empty()) return;
    const Serve serve = std::move(queue_.front());
    queue_.pop_front();
    waiting_ = queue_.size();
    changed_.notify_all();
    lock.unlock();
    serve();
    lock.lock();
  }
}

void ConnectionQueue::shut_down() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

}  // namespace loopscope::daemon
