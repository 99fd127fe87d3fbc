#include "daemon/service/observe/fault_log.hpp"

#include <spdlog/spdlog.h>

namespace loopscope::daemon {
namespace {

/// An outage is met while connecting, while waiting and while writing: three sides of one thing.
constexpr std::size_t kMostMessages = 3;

}  // namespace

void FaultLog::fault(const std::string& subject, const std::string& message, const void* user) {
  const std::lock_guard lock(mutex_);
  metrics_.fault(subject);
  Standing& standing = standing_[subject];
  standing.users.insert(user);
  if (standing.said.size() >= kMostMessages || !standing.said.insert(message).second) return;
  spdlog::error("{}: {}", subject, message);
}

void FaultLog::recovered(const std::string& subject, const void* user) {
  const std::lock_guard lock(mutex_);
  if (end_for(subject, user)) spdlog::info("{}: works again", subject);
}

void FaultLog::leave(const std::string& subject, const void* user) {
  const std::lock_guard lock(mutex_);
  end_for(subject, user);
}

bool FaultLog::end_for(const std::string& subject, const void* user) {
  const auto standing = standing_.find(subject);
  if (standing == standing_.end()) return false;
  standing->second.users.erase(user);
  if (!standing->second.users.empty()) return false;
  standing_.erase(standing);
  metrics_.recovered(subject);
  return true;
}

}  // namespace loopscope::daemon
