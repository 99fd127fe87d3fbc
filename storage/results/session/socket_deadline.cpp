#include "storage/results/session/socket_deadline.hpp"

#include <sys/socket.h>
#include <utility>

namespace loopscope::storage {

SocketDeadline::SocketDeadline(int socket, std::optional<std::chrono::seconds> patience,
                               std::function<void()> tell_server)
    : socket_(socket), patience_(patience), tell_server_(std::move(tell_server)) {
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
    if (deadline_ && *deadline_ <= Clock::now()) expire(lock);
  }
}

void SocketDeadline::expire(std::unique_lock<std::mutex>& lock) {
  expired_ = true;
  deadline_.reset();
  // The owner may learn meanwhile that the statement was ended, and that it has expired.
  lock.unlock();
  tell_server_();
  ::shutdown(socket_, SHUT_RDWR);
  lock.lock();
}

}  // namespace loopscope::storage
