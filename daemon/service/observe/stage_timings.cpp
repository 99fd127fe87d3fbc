#include "daemon/service/observe/stage_timings.hpp"

#include <utility>

namespace loopscope::daemon {
namespace {

/// A crash loses no more than this of the record of costs, and a lane rewrites its row no oftener.
constexpr std::chrono::minutes kStoreEvery{1};

}  // namespace

void StageTimings::add(const storage::StageCost& cost) {
  storage::add(sum_, cost);
  storage::add(untaken_, cost);
}

std::optional<storage::StageCost> StageTimings::take(bool at_once) {
  const Clock::time_point now = Clock::now();
  if (untaken_.loops == 0 || (!at_once && now - taken_at_ < kStoreEvery)) return std::nullopt;
  taken_at_ = now;
  return std::exchange(untaken_, {});
}

}  // namespace loopscope::daemon
