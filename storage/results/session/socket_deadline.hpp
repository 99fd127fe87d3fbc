#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace loopscope::storage {

/// Ends a blocking wait on a socket from outside: libpqxx 6.4 has no deadlines of its own. When an
/// armed deadline passes, the server is told that nobody waits any more, and the socket is shut
/// down, which libpq sees as a connection that broke.
class SocketDeadline {
 public:
  /// `socket` must stay open as long as this object lives; without `patience` nothing ever happens.
  /// `tell_server` is called by another thread, before the socket is shut down.
  SocketDeadline(int socket, std::optional<std::chrono::seconds> patience,
                 std::function<void()> tell_server);

  /// The deadline is armed as long as the guard lives.
  class Guard {
   public:
    explicit Guard(SocketDeadline& deadline) : deadline_(deadline) { deadline_.restart(); }
    ~Guard() { deadline_.disarm(); }
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

   private:
    SocketDeadline& deadline_;
  };

  /// Counts from now: each statement under one guard has the whole time.
  void restart();

  /// Whether a deadline has ever passed: the connection is given up. Thread-safe.
  [[nodiscard]] bool expired();

 private:
  using Clock = std::chrono::steady_clock;

  void disarm();
  void watch(const std::stop_token& stop);
  void expire(std::unique_lock<std::mutex>& lock);

  int socket_;
  std::optional<std::chrono::seconds> patience_;
  std::function<void()> tell_server_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<Clock::time_point> deadline_;
  bool expired_ = false;
  std::jthread watcher_;  // last: it ends before what it uses
};

}  // namespace loopscope::storage
