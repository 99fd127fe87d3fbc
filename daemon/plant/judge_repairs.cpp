#include "daemon/plant/judge_repairs.hpp"

#include <spdlog/spdlog.h>
#include <utility>
#include <vector>

#include "daemon/service/historians/storage_settings.hpp"

namespace loopscope::daemon {
namespace {

/// So many take some tens of milliseconds to read.
constexpr std::size_t kRepairsAtOnce = 100;

}  // namespace

JudgedBatch judge_some_repairs(storage::RepairJudgements& judgements, std::int64_t behind) {
  std::vector<storage::JudgedRepair> judged;
  for (storage::DueRepair& due : judgements.due(kRepairsAtOnce, behind)) {
    core::repair::RepairJudgement judgement = core::repair::judge_repair(due.windows);
    judged.push_back({std::move(due), std::move(judgement)});
  }
  if (judged.empty()) return {0, behind};
  judgements.store(judged);
  return {judged.size(), judged.back().repair.maintenance_event_id};
}

namespace {

void judge_due(storage::RepairJudgements& judgements, SharedServices& tools) {
  std::size_t count = 0;
  for (JudgedBatch batch; !tools.stop.stop_requested(); count += batch.count) {
    batch = judge_some_repairs(judgements, batch.last);
    if (batch.count == 0) break;
  }
  if (count > 0) spdlog::info("repairs: {} judged", count);
}

}  // namespace

void judge_repairs(const config::Settings& settings, SharedServices& tools) {
  storage::RepairJudgements judgements(results_connection(settings));
  judge_due(judgements, tools);
}

void judge_repairs_anew(const config::Settings& settings, SharedServices& tools,
                        std::span<const std::int64_t> loop_ids) {
  storage::RepairJudgements judgements(results_connection(settings));
  judgements.make_due(loop_ids);
  judge_due(judgements, tools);
}

}  // namespace loopscope::daemon
