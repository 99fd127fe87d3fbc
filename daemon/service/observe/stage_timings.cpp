#include "daemon/service/observe/stage_timings.hpp"

#include <fmt/format.h>
#include <utility>

namespace loopscope::daemon {
namespace {

/// A crash loses no more than this of the record of costs, and a worker rewrites its row no
/// oftener.
constexpr std::chrono::minutes kStoreEvery{1};

constexpr double kMillisecondsPerSecond = 1e3;

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

std::string cost_text(const storage::StageCost& cost) {
  if (cost.loops == 0) return "";
  const auto each = [&](double seconds) {
    return kMillisecondsPerSecond * seconds / static_cast<double>(cost.loops);
  };
  std::string models;
  if (cost.modelled > 0) {
    const double of_one =
        kMillisecondsPerSecond * cost.model_s / static_cast<double>(cost.modelled);
    models = fmt::format(" ({:.1f} each of {})", of_one, cost.modelled);
  }
  return fmt::format(
      "ms a loop: claim {:.2f}, fetch {:.2f}, prepare {:.2f}, statistics {:.2f}, model {:.2f}{}, "
      "decide {:.2f}, write {:.2f}, waiting for a core {:.2f}",
      each(cost.claim_s), each(cost.fetch_s), each(cost.prepare_s), each(cost.statistics_s),
      each(cost.model_s), models, each(cost.decide_s), each(cost.write_s), each(cost.wait_s));
}

}  // namespace loopscope::daemon
