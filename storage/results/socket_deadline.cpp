#include "storage/results/socket_deadline.hpp"

#include <sys/socket.h>

namespace loopscope::storage {

SocketDeadline::SocketDeadline(int socket, std::optional<std::chrono::seconds> patience)
    : socket_(socket), patience_(patience) {
  if (patience_) {
    watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
  }
}

bool SocketDeadline::expired() {
  const std::lock_guard lock(mutex_);
  return expired_;
}

void SocketDeadline::restart() {
  if (!patience_) return;
  const std::lock_guard lock(mutex_);
  deadline_ = Clock::now() + *patience_;
  changed_.notify_one();
}

void SocketDeadline::disarm() {
  const std::lock_guard lock(mutex_);
  deadline_.reset();
}

void SocketDeadline::watch(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return deadline_.has_value(); })) {
    // By the time this wakes up the deadline may be gone or be a later one: look again.
    const Clock::time_point until = *deadline_;
    changed_.wait_until(lock, stop, until, [] { return false; });
    if (stop.stop_requested()) return;
    if (deadline_ && *deadline_ <= Clock::now()) {
      ::shutdown(socket_, SHUT_RDWR);
      expired_ = true;
      deadline_.reset();
    }
  }
}

}  // namespace loopscope::storage
