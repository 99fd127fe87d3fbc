#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace loopscope::daemon {

/// Accepted connections that wait for one of a few threads. No more than `most_waiting` wait here:
/// then push() does, and further clients stay in the kernel's own queue, so that no crowd can take
/// the process's memory or descriptors.
class ConnectionQueue {
 public:
  using Serve = std::function<void()>;  ///< must not throw

  ConnectionQueue(std::size_t threads, std::size_t most_waiting);
  ~ConnectionQueue() { shut_down(); }
  ConnectionQueue(const ConnectionQueue&) = delete;
  ConnectionQueue& operator=(const ConnectionQueue&) = delete;

  /// Thread-safe, as long as shut_down() comes later.
  void push(Serve serve);
  /// Whether somebody waits for a thread.
  [[nodiscard]] bool crowded() const { return waiting_.load() > 0; }
  /// Serves those who wait, then ends the threads. May be called again.
  void shut_down();

 private:
  void work();

  std::size_t most_waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Serve> queue_;
  std::atomic<std::size_t> waiting_ = 0;
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace loopscope::daemon
