#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>

#include "daemon/monitor/metrics.hpp"

namespace loopscope::daemon {

/// Says a lasting fault once and its end once, whatever the number of times and threads it is met
/// in, and in however many words: lanes that are at different statements meet the same outage
/// with different messages. Thread-safe.
class FaultLog {
 public:
  explicit FaultLog(Metrics& metrics) : metrics_(metrics) {}

  /// Logs `message` as an error unless it was said since the fault of `subject` began; after a few
  /// different ones no more.
  void fault(const std::string& subject, const std::string& message);
  /// Logs the end of the fault of `subject`, if one stands.
  void recovered(const std::string& subject);

 private:
  Metrics& metrics_;
  std::mutex mutex_;
  std::map<std::string, std::set<std::string>> standing_;
};

}  // namespace loopscope::daemon
