#include "daemon/service/fault_log.hpp"

#include <spdlog/spdlog.h>

namespace loopscope::daemon {

void FaultLog::fault(const std::string& subject, const std::string& message) {
  const std::lock_guard lock(mutex_);
  std::string& standing = standing_[subject];
  if (standing == message) return;
  standing = message;
  spdlog::error("{}: {}", subject, message);
}

void FaultLog::recovered(const std::string& subject) {
  const std::lock_guard lock(mutex_);
  if (standing_.erase(subject) > 0) spdlog::info("{}: works again", subject);
}

}  // namespace loopscope::daemon
