#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>

#include "daemon/monitor/metrics.hpp"

namespace loopscope::daemon {

/// Says a lasting fault once and its end once, whatever the number of times and threads it is met
/// in, and in however many words: workers that are at different statements meet the same outage
/// with different messages. A database that can be read but not written to works for one user and
/// fails another: a fault stands as long as it does for anybody. Thread-safe.
class FaultLog {
 public:
  explicit FaultLog(Metrics& metrics) : metrics_(metrics) {}

  /// Logs `message` as an error unless it was said since the fault of `subject` began; after a few
  /// different ones no more. `user` is who met it, where several may.
  void fault(const std::string& subject, const std::string& message, const void* user = nullptr);
  /// It works for that user. Logs the end of the fault of `subject` when that was the last one for
  /// whom it stood.
  void recovered(const std::string& subject, const void* user = nullptr);
  /// The user has gone, or nobody asks for the subject any more: whether it works is not known.
  void leave(const std::string& subject, const void* user = nullptr);

 private:
  /// True when the fault stood, and no longer stands for anybody.
  bool end_for(const std::string& subject, const void* user);
  struct Standing {
    std::set<std::string> said;
    std::set<const void*> users;
  };
  Metrics& metrics_;
  std::mutex mutex_;
  std::map<std::string, Standing> standing_;
};

}  // namespace loopscope::daemon
