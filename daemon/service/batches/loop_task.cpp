#include "daemon/service/batches/loop_task.hpp"

#include "daemon/service/batches/analyse_window.hpp"
#include "daemon/service/batches/data_problems.hpp"
#include "daemon/service/batches/model_turns.hpp"
#include "daemon/service/windows/slot.hpp"

namespace loopscope::daemon {
namespace {

using storage::AnalysisRecord;
using storage::CompletedLoop;
using storage::StoredDigest;

/// The record of a slot whose input is not the stored one; nullopt = the stored analysis holds.
std::optional<AnalysisRecord> changed_record(const LoopTask& visit, const LoopInput& input,
                                             const StoredDigest* stored,
                                             const AnalysisOrders& orders) {
  const storage::CatalogueEntry& loop = visit.claim->loop;
  if (stored != nullptr && digest_of(loop, input, orders.settings_json) == stored->input_digest) {
    return std::nullopt;
  }
  const config::Settings& settings = orders.settings;
  // What was judged with a model is judged anew with one.
  const ModelPolicy wish =
      stored != nullptr && stored->modelled
          ? ModelPolicy{}
          : model_wish(settings, orders.enabled_loops, *visit.claim, input.at_slot.slot_end_us);
  AnalysisRecord record =
      analyse_window(loop, input, settings.analysis, orders.settings_json, wish);
  record.fetch_ms = visit.fetch_ms;
  return record;
}

void add_problems(const LoopTask& visit, std::size_t max_samples, CompletedLoop& completed) {
  completed.problems = tag_problems(visit.claim->loop, visit.newest.at_slot, max_samples);
  if (!completed.record) return;
  for (storage::DataProblem& problem : flag_problems(completed.record->diagnosis)) {
    completed.problems.push_back(std::move(problem));
  }
}

}  // namespace

StoredAnalyses::StoredAnalyses(const std::vector<StoredDigest>& rows) {
  for (const StoredDigest& row : rows) rows_[{row.loop_id, row.slot_end_us}] = row;
}

const StoredDigest* StoredAnalyses::find(std::int64_t loop_id, std::int64_t slot_end_us) const {
  const auto found = rows_.find({loop_id, slot_end_us});
  return found == rows_.end() ? nullptr : &found->second;
}

std::vector<std::int64_t> slots_to_check(const storage::ClaimedLoop& claim,
                                         std::int64_t newest_end_us, const StoredAnalyses& stored,
                                         int horizon) {
  std::vector<std::int64_t> ends;
  for (const std::int64_t end :
       earlier_slots(newest_end_us, claim.last_slot_end_us, claim.loop.period_s, horizon)) {
    const StoredDigest* row = stored.find(claim.loop.loop_id, end);
    if (row != nullptr && row->same_settings) ends.push_back(end);
  }
  return ends;
}

CompletedLoop complete_visit(const LoopTask& visit, const StoredAnalyses& stored,
                             const AnalysisOrders& orders) {
  const config::Settings& settings = orders.settings;
  const storage::ClaimedLoop& claim = *visit.claim;
  const std::int64_t slot_end_us = visit.newest.at_slot.slot_end_us;
  const StoredDigest* known = stored.find(claim.loop.loop_id, slot_end_us);
  const double period_s = claim.loop.period_s, settle_s = settings.schedule.settle_s;
  CompletedLoop completed{
      claim.loop.loop_id, claim.fence, slot_end_us,
      visit.by_rows ? next_due_by_rows(slot_end_us, claim.database_now_us, period_s, settle_s)
                    : next_due(slot_end_us, period_s, settle_s),
      changed_record(visit, visit.newest, known, orders)};
  completed.judged = completed.record ? shows_a_loop(completed.record->diagnosis.verdict.code)
                                      : known != nullptr && known->usable;
  if (claim.last_slot_end_us && *claim.last_slot_end_us < slot_end_us) {
    completed.previous_slot_end_us = claim.last_slot_end_us;
  }
  add_problems(visit, settings.analysis.prepare.window_samples, completed);
  for (const LoopInput& input : visit.earlier) {
    const StoredDigest* row = stored.find(claim.loop.loop_id, input.at_slot.slot_end_us);
    auto record = changed_record(visit, input, row, orders);
    if (record) completed.revised.push_back(std::move(*record));
  }
  return completed;
}

}  // namespace loopscope::daemon
