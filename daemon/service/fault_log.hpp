#pragma once

#include <map>
#include <mutex>
#include <string>

namespace loopscope::daemon {

/// Says a lasting fault once and its end once, whatever the number of times and threads it is met
/// in. Thread-safe.
class FaultLog {
 public:
  /// Logs `message` as an error unless the same fault of `subject` is already standing.
  void fault(const std::string& subject, const std::string& message);
  /// Logs the end of the fault of `subject`, if one stands.
  void recovered(const std::string& subject);

 private:
  std::mutex mutex_;
  std::map<std::string, std::string> standing_;
};

}  // namespace loopscope::daemon
