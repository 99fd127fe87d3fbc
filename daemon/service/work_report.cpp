#include "daemon/service/work_report.hpp"

#include <spdlog/spdlog.h>
#include <utility>

#include "daemon/service/observe/cost_text.hpp"
#include "daemon/service/threads/worker_identity.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::chrono::minutes kSayEvery{1};

}  // namespace

void WorkReport::add(const storage::WriteCount& count, const storage::StageCost& cost) {
  daemon::add(count_, count);
  cost_ = cost;
  if (Clock::now() - said_at_ >= kSayEvery) say();
}

void WorkReport::say() {
  said_at_ = Clock::now();
  const storage::StageCost since = difference(cost_, told_);
  // Of loops that were all put off the log knows already why.
  const storage::WriteCount& c = count_;
  if (c.inserted + c.revised + c.unchanged + c.fenced_off == 0) return;
  spdlog::info("{}; {}", count_text(std::exchange(count_, {})), cost_text(since));
  told_ = cost_;
}

}  // namespace loopscope::daemon
