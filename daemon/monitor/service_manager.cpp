#include "daemon/monitor/service_manager.hpp"

#include <cstdint>
#include <systemd/sd-daemon.h>

#include "daemon/monitor/plain_line.hpp"

namespace loopscope::daemon {
namespace {

/// The result is no news to anybody: a manager that has gone away cannot be told so.
void notify(const std::string& state) {
  static_cast<void>(sd_notify(0, state.c_str()));
}

/// A line break in the text would begin another assignment.
std::string status_line(const std::string& text) {
  constexpr std::size_t kMostStatusBytes = 512;
  return "STATUS=" + plain_line(text, kMostStatusBytes);
}

}  // namespace

void ServiceManager::ready(const std::string& status) {
  notify("READY=1\n" + status_line(status));
}

void ServiceManager::reloading() {
  notify("RELOADING=1");
}

void ServiceManager::stopping(const std::string& status) {
  notify("STOPPING=1\n" + status_line(status));
}

void ServiceManager::status(const std::string& text) {
  notify(status_line(text));
}

void ServiceManager::feed_watchdog() {
  notify("WATCHDOG=1");
}

void ServiceManager::extend_timeout(std::chrono::microseconds time) {
  notify("EXTEND_TIMEOUT_USEC=" + std::to_string(time.count()));
}

std::optional<std::chrono::microseconds> ServiceManager::watchdog_time() {
  std::uint64_t microseconds = 0;
  if (sd_watchdog_enabled(0, &microseconds) <= 0) return std::nullopt;
  return std::chrono::microseconds(microseconds);
}

}  // namespace loopscope::daemon
