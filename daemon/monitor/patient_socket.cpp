#include "daemon/monitor/patient_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace loopscope::daemon {
namespace {

using std::chrono::milliseconds;

/// How often the patience is asked for while nothing comes.
constexpr milliseconds kSlice{50};
/// The share of the patience that finish() has with a client that goes on sending.
constexpr int kFinishingShare = 20;
constexpr std::size_t kMostFinishingBytes = std::size_t{64} * 1024;

}  // namespace

PatientSocket::PatientSocket(int descriptor, Patience patience, std::size_t most_bytes)
    : descriptor_(descriptor), patience_(std::move(patience)), bytes_left_(most_bytes) {}

PatientSocket::~PatientSocket() {
  close(descriptor_);
}

void PatientSocket::enter(Phase phase) {
  if (phase_ == phase) return;
  phase_ = phase;
  phase_start_ = Clock::now();
}

bool PatientSocket::await(short event) {
  for (;;) {
    const milliseconds patience = patience_() / (phase_ == Phase::finishing ? kFinishingShare : 1);
    const Clock::duration left = phase_start_ + patience - Clock::now();
    given_up_ = left <= Clock::duration::zero();
    if (given_up_) return false;
    const milliseconds wait = std::min(std::chrono::ceil<milliseconds>(left), kSlice);
    pollfd poll_request{descriptor_, event, 0};
    const int ready = poll(&poll_request, 1, static_cast<int>(wait.count()));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

bool PatientSocket::receive() {
  const std::size_t most = std::min(buffer_.size(), bytes_left_);
  if (most == 0 || !await(POLLIN)) return false;
  const ssize_t received = recv(descriptor_, buffer_.data(), most, MSG_DONTWAIT);
  if (received <= 0) return false;
  buffer_at_ = 0;
  buffer_end_ = static_cast<std::size_t>(received);
  bytes_left_ -= buffer_end_;
  return true;
}

std::size_t PatientSocket::read(char* to, std::size_t size) {
  if (buffer_at_ == buffer_end_ && !receive()) return 0;
  const std::size_t count = std::min(size, buffer_end_ - buffer_at_);
  std::memcpy(to, buffer_.data() + buffer_at_, count);
  buffer_at_ += count;
  return count;
}

bool PatientSocket::write(std::string_view text) {
  enter(Phase::writing);
  while (!text.empty()) {
    if (!await(POLLOUT)) return false;
    const ssize_t sent = send(descriptor_, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) return false;
    if (sent > 0) text.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

void PatientSocket::finish() {
  if (given_up_) return;
  enter(Phase::finishing);
  bytes_left_ = kMostFinishingBytes;
  shutdown(descriptor_, SHUT_WR);
  while (receive()) {
  }
}

}  // namespace loopscope::daemon
