#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace loopscope::daemon {

/// What the daemon tells systemd (Type=notify). Without a service manager (no NOTIFY_SOCKET) every
/// call does nothing, and one that has gone away is no error. A call waits while the manager's
/// queue is full. May be made from several threads.
class ServiceManager {
 public:
  /// The service has started, or has read its settings again. `status` is shown by
  /// `systemctl status`, as one line.
  static void ready(const std::string& status);
  /// The settings are being read again; ready() has to follow.
  static void reloading();
  /// The end has begun: what is in hand is finished.
  static void stopping(const std::string& status);
  static void status(const std::string& text);
  /// Every thread that must advance has done so: the watchdog's time starts anew.
  static void feed_watchdog();
  /// Starting, reloading or stopping takes so much longer, from now on.
  static void extend_timeout(std::chrono::microseconds time);

  /// Within what time feed_watchdog() is expected again and again (feed it twice as often);
  /// nullopt = the unit has no watchdog, or it watches another process.
  [[nodiscard]] static std::optional<std::chrono::microseconds> watchdog_time();
};

}  // namespace loopscope::daemon
