#include "daemon/service/fault_log.hpp"

#include <spdlog/spdlog.h>

namespace loopscope::daemon {
namespace {

/// An outage is met while connecting, while waiting and while writing: three sides of one thing.
constexpr std::size_t kMostMessages = 3;

}  // namespace

void FaultLog::fault(const std::string& subject, const std::string& message) {
  const std::lock_guard lock(mutex_);
  metrics_.fault(subject);
  std::set<std::string>& said = standing_[subject];
  if (said.size() >= kMostMessages || !said.insert(message).second) return;
  spdlog::error("{}: {}", subject, message);
}

void FaultLog::recovered(const std::string& subject) {
  const std::lock_guard lock(mutex_);
  if (standing_.erase(subject) == 0) return;
  metrics_.recovered(subject);
  spdlog::info("{}: works again", subject);
}

}  // namespace loopscope::daemon
