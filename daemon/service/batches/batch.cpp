#include "daemon/service/batches/batch.hpp"

#include <spdlog/spdlog.h>

#include "daemon/service/windows/slot.hpp"

namespace loopscope::daemon {
namespace {

constexpr double kSecondsPerMillisecond = 1e-3;

void add_input(const LoopInput& input, storage::StageCost& cost) {
  const core::signal::LoopWindow& window = input.at_slot.window;
  cost.prepare_s += input.first_look_ms * kSecondsPerMillisecond;
  cost.values += window.sp.size() + window.pv.size() + window.op.size() + window.mv.size();
}

void add_record(const storage::AnalysisRecord& record, storage::StageCost& cost) {
  ++cost.analysed;
  cost.statistics_s += record.statistics_ms * kSecondsPerMillisecond;
  if (!record.model_ms) return;
  ++cost.modelled;
  cost.model_s += *record.model_ms * kSecondsPerMillisecond;
}

}  // namespace

void set_aside(const storage::ClaimedLoop& claim, const Failure& failure, Batch& batch) {
  const double pause_s = retry_pause_s(claim.attempts);
  spdlog::error("loop \"{}\" failed, next try in {:.0f} s: {} HINT: {}", claim.loop.name, pause_s,
                failure.what(), failure.hint());
  if (!batch.first_failure) batch.first_failure = failure;
  batch.failed.push_back({claim.loop.loop_id, claim.fence, failure.what(), pause_s});
}

void postpone(const Claims& claims, const Failure& failure, double pause_s, Batch& batch) {
  if (!batch.first_failure) batch.first_failure = failure;
  for (const storage::ClaimedLoop* claim : claims) {
    batch.failed.push_back({claim->loop.loop_id, claim->fence, failure.what(), pause_s, false});
  }
}

void add_reading(double elapsed_s, std::span<const LoopTask> tasks, storage::StageCost& cost) {
  const double prepared_s = cost.prepare_s;
  for (const LoopTask& task : tasks) {
    add_input(task.newest, cost);
    for (const LoopInput& input : task.earlier) add_input(input, cost);
  }
  cost.fetch_s += elapsed_s - (cost.prepare_s - prepared_s);
}

void add_analyses(double elapsed_s, std::span<const storage::CompletedLoop> completed,
                  storage::StageCost& cost) {
  const double claimed_s = cost.statistics_s + cost.model_s;
  for (const storage::CompletedLoop& loop : completed) {
    if (loop.record) add_record(*loop.record, cost);
    for (const storage::AnalysisRecord& record : loop.revised) add_record(record, cost);
  }
  cost.decide_s += elapsed_s - (cost.statistics_s + cost.model_s - claimed_s);
}

}  // namespace loopscope::daemon
