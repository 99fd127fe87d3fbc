#include "daemon/plant/judge_repairs.hpp"

#include <spdlog/spdlog.h>
#include <utility>
#include <vector>

#include "daemon/service/historians/storage_settings.hpp"

namespace loopscope::daemon {
namespace {

/// So many keep a transaction well below a second.
constexpr std::size_t kRepairsAtOnce = 100;

}  // namespace

std::size_t judge_some_repairs(storage::RepairJudgements& judgements) {
  std::vector<storage::JudgedRepair> judged;
  for (storage::DueRepair& due : judgements.due(kRepairsAtOnce)) {
    core::repair::RepairJudgement judgement = core::repair::judge_repair(due.windows);
    judged.push_back({std::move(due), std::move(judgement)});
  }
  if (!judged.empty()) judgements.store(judged);
  return judged.size();
}

void judge_repairs(const config::Settings& settings, SharedServices& tools) {
  storage::RepairJudgements judgements(results_connection(settings));
  std::size_t count = 0;
  while (!tools.stop.stop_requested()) {
    const std::size_t some = judge_some_repairs(judgements);
    if (some == 0) break;
    count += some;
  }
  if (count > 0) spdlog::info("repairs: {} judged", count);
}

}  // namespace loopscope::daemon
