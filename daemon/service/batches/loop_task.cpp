#include "daemon/service/batches/loop_task.hpp"

#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "core/hos/bicoherence/triple_sums.hpp"
#include "core/signal/grid.hpp"
#include "core/signal/microseconds.hpp"
#include "core/signal/window_digest.hpp"
#include "daemon/output/analysis_json.hpp"
#include "daemon/output/model_json.hpp"
#include "daemon/service/batches/data_problems.hpp"
#include "daemon/service/windows/loop_facts.hpp"
#include "daemon/service/windows/slot.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::LoopWindow;
using storage::AnalysisRecord;
using storage::CompletedLoop;
using storage::StoredDigest;

/// Steele, Lea and Flood (2014): every bit of the number reaches every bit of the result.
std::uint64_t mixed(std::uint64_t number) {
  number += 0x9E3779B97F4A7C15U;
  number = (number ^ (number >> 30)) * 0xBF58476D1CE4E5B9U;
  number = (number ^ (number >> 27)) * 0x94D049BB133111EBU;
  return number ^ (number >> 31);
}

/// By lot, not in a fixed order: analyses may skip slots in any rhythm, and every loop has to have
/// its turn all the same.
bool is_its_turn(const storage::CatalogueEntry& loop, std::int64_t slot_end_us, int every_slots) {
  const std::int64_t period_us = core::signal::microseconds(loop.period_s);
  const auto slot = static_cast<std::uint64_t>(slot_end_us / period_us);
  const std::uint64_t lot = mixed(slot ^ mixed(static_cast<std::uint64_t>(loop.loop_id)));
  return lot % static_cast<std::uint64_t>(every_slots) == 0;
}

/// What may be flagged. False discoveries are controlled over all loops at once, which a single
/// loop cannot know: a tenth of the rate is above where the control ends while fewer than a third
/// of the loops are at fault.
core::ModelTrigger may_be_flagged(const config::FlagSettings& flags) {
  constexpr double kShareOfRate = 0.1;
  return {kShareOfRate * flags.false_discovery_rate, flags.min_confidence};
}

/// Nothing was said of the loop for want of data: what was said before may still hold.
bool was_silent(const storage::LastVerdict& last) {
  return !shows_a_loop(last.code);
}

/// core::diagnose(), each stage on the driver's books and in the record.
core::Diagnosis staged_diagnosis(const LoopInput& input, const core::AnalysisSettings& settings,
                                 const core::LoopFacts& facts, const ModelPolicy& wish,
                                 StageDriver& driver, storage::AnalysisRecord& record) {
  using storage::StageCost;
  driver.split(&StageCost::decide_s);
  const core::ModelPlan plan{.cause = wish.cause, .traces = false, .done = [&](core::Stage stage) {
                               if (stage == core::Stage::statistics) {
                                 record.statistics_ms = driver.split(&StageCost::statistics_s);
                               }
                               if (stage == core::Stage::model)
                                 record.model_ms = driver.split(&StageCost::model_s);
                             }};
  const LoopWindow* longer = input.long_window ? &*input.long_window : nullptr;
  return core::diagnose(input.first, settings, facts, longer, plan);
}

void describe_window(const LoopWindowAtSlot& at_slot, storage::AnalysisRecord& record) {
  const LoopWindow& window = at_slot.window;
  const core::signal::Grid grid{window.start_us, window.sample_interval_s, window.size()};
  record.slot_end_us = at_slot.slot_end_us;
  record.window_start_us = window.size() > 0 ? grid.start_us : at_slot.slot_end_us;
  record.window_end_us = window.size() > 0 ? grid.time_us(window.size() - 1) : at_slot.slot_end_us;
  record.samples = window.size();
  record.sample_interval_s = window.size() > 1 ? window.sample_interval_s : 0.0;
}

void describe_json(AnalysisRecord& record) {
  const core::Evidence& evidence = record.diagnosis.evidence;
  if (evidence.hos_slow) {
    record.hos_slow_json = slow_look_json(*evidence.hos_slow, evidence.tested_on).dump();
  }
  if (evidence.model) record.model_json = json_text(model_json(evidence.model));
}

/// The record of a slot whose input is not the stored one; nullopt = the stored analysis holds.
std::optional<AnalysisRecord> changed_record(const LoopTask& task, const LoopInput& input,
                                             const StoredDigest* stored,
                                             const AnalysisOrders& orders, StageDriver& driver) {
  const storage::CatalogueEntry& loop = task.claim->loop;
  if (stored != nullptr && digest_of(loop, input, orders.settings_json) == stored->input_digest) {
    return std::nullopt;
  }
  const config::Settings& settings = orders.settings;
  // What was judged with a model is judged anew with one.
  const ModelPolicy wish =
      stored != nullptr && stored->modelled
          ? ModelPolicy{}
          : model_wish(settings, orders.enabled_loops, *task.claim, input.at_slot.slot_end_us);
  AnalysisRecord record =
      analyse_window(loop, input, settings.analysis, orders.settings_json, driver, wish);
  record.fetch_ms = task.fetch_ms;
  return record;
}

void add_problems(const LoopTask& task, std::size_t max_samples, CompletedLoop& completed) {
  completed.problems = tag_problems(task.claim->loop, task.newest.at_slot, max_samples);
  if (!completed.record) return;
  for (storage::DataProblem& problem : flag_problems(completed.record->diagnosis)) {
    completed.problems.push_back(std::move(problem));
  }
}

/// A slot of the past, without a record where pv was not recorded then.
CompletedLoop complete_past(const LoopTask& task, const AnalysisOrders& orders,
                            StageDriver& driver) {
  const storage::ClaimedLoop& claim = *task.claim;
  CompletedLoop completed;
  completed.loop_id = claim.loop.loop_id;
  completed.fence = claim.fence;
  completed.slot_end_us = claim.past->end_us;
  completed.kept_due_us = claim.kept_due_us();
  const TagReading* pv = find_reading(task.newest.at_slot.tags, "pv");
  if (pv != nullptr && pv->newest_row_us)
    completed.record = changed_record(task, task.newest, nullptr, orders, driver);
  return completed;
}

}  // namespace

ModelPolicy model_wish(const config::Settings& settings, std::size_t enabled_loops,
                       const storage::ClaimedLoop& claim, std::int64_t slot_end_us) {
  const config::ScheduleSettings& schedule = settings.schedule;
  const core::ModelTrigger cause = may_be_flagged(settings.flags);
  const auto& last = claim.last_verdict;
  const bool always =
      enabled_loops <= static_cast<std::size_t>(schedule.model_all_up_to) ||
      (last && (was_silent(*last) || cause.given_by(last->code, last->confidence, last->p))) ||
      is_its_turn(claim.loop, slot_end_us, schedule.model_every_slots);
  return {always ? std::nullopt : std::optional(cause)};
}

std::string digest_of(const storage::CatalogueEntry& loop, const LoopInput& input,
                      const std::string& settings_json) {
  std::string facts = settings_json + loop.loop_type;
  if (loop.pv_range) facts += fmt::format("{} {}", loop.pv_range->low, loop.pv_range->high);
  std::string digest = core::signal::window_digest(input.at_slot.window, facts);
  return input.long_window ? core::signal::window_digest(*input.long_window, digest) : digest;
}

storage::AnalysisRecord analyse_window(const storage::CatalogueEntry& loop, const LoopInput& input,
                                       const core::AnalysisSettings& settings,
                                       const std::string& settings_json, StageDriver& driver,
                                       const ModelPolicy& wish) {
  storage::AnalysisRecord record;
  driver.run(&storage::StageCost::decide_s, [&] {
    describe_window(input.at_slot, record);
    record.input_digest = digest_of(loop, input, settings_json);
    // Verdicts are reproducible to the last digit on one processor path only.
    record.program_version =
        std::string(LOOPSCOPE_VERSION " ") + std::string(core::hos::processor_path());
    record.settings_json = settings_json;
    record.pv_past = input.at_slot.window.pv_past;
    record.diagnosis = staged_diagnosis(input, settings, loop_facts(loop, input.at_slot.window),
                                        wish, driver, record);
    describe_json(record);
  });
  ++driver.cost().analysed;
  if (record.model_ms) ++driver.cost().modelled;
  record.prepare_ms = input.prepare_ms;
  record.analyse_ms = input.prepare_ms + driver.last_ms();
  return record;
}

StoredAnalyses::StoredAnalyses(const std::vector<StoredDigest>& rows) {
  for (const StoredDigest& row : rows) rows_[{row.loop_id, row.slot_end_us}] = row;
}

const StoredDigest* StoredAnalyses::find(std::int64_t loop_id, std::int64_t slot_end_us) const {
  const auto found = rows_.find({loop_id, slot_end_us});
  return found == rows_.end() ? nullptr : &found->second;
}

CompletedLoop complete_task(const LoopTask& task, const StoredAnalyses& stored,
                            const AnalysisOrders& orders, StageDriver& driver) {
  const config::Settings& settings = orders.settings;
  const storage::ClaimedLoop& claim = *task.claim;
  if (claim.past) return complete_past(task, orders, driver);
  const std::int64_t slot_end_us = task.newest.at_slot.slot_end_us;
  const StoredDigest* known = stored.find(claim.loop.loop_id, slot_end_us);
  const double period_s = claim.loop.period_s, settle_s = settings.schedule.settle_s;
  CompletedLoop completed{
      claim.loop.loop_id, claim.fence, slot_end_us,
      task.by_rows ? next_due_by_rows(slot_end_us, claim.database_now_us, period_s, settle_s)
                   : next_due(slot_end_us, period_s, settle_s),
      changed_record(task, task.newest, known, orders, driver)};
  completed.judged = completed.record ? shows_a_loop(completed.record->diagnosis.verdict.code)
                                      : known != nullptr && known->usable;
  if (claim.last_slot_end_us && *claim.last_slot_end_us < slot_end_us) {
    completed.previous_slot_end_us = claim.last_slot_end_us;
  }
  add_problems(task, settings.analysis.prepare.window_samples, completed);
  for (const LoopInput& input : task.earlier) {
    const StoredDigest* row = stored.find(claim.loop.loop_id, input.at_slot.slot_end_us);
    auto record = changed_record(task, input, row, orders, driver);
    if (record) completed.revised.push_back(std::move(*record));
  }
  return completed;
}

void keep_error(const LoopTask& task, KeptErrors& errors) {
  const LoopWindow& window = task.newest.at_slot.window;
  const core::signal::Samples& error = task.newest.first.loop.error;
  // Of a window that was cut the error begins later.
  if (error.size() != window.size() || !errors.has_room()) return;
  errors.keep(task.claim->loop.loop_id, task.newest.at_slot.slot_end_us,
              core::plant::PackedError(error, window.sample_interval_s, window.start_us,
                                       core::plant::error_about(task.newest.first.loop)));
}

}  // namespace loopscope::daemon
