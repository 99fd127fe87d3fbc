#include "daemon/service/batches/batch_reader.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "core/signal/microseconds.hpp"
#include "daemon/service/historians/source_gate.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/observe/stage_timings.hpp"
#include "daemon/service/windows/loop_slot.hpp"

namespace loopscope::daemon {
namespace {

/// SQLSTATE: one loop may fit where a batch did not.
constexpr const char* kServerOutOfMemory = "53200";

/// Slots before the newest one that are looked at again: those of the horizon that are stored and
/// were analysed with the settings in force (others keep what they were judged by). Newest first.
std::vector<std::int64_t> slots_to_check(const storage::ClaimedLoop& claim,
                                         std::int64_t newest_end_us, const StoredAnalyses& stored,
                                         int horizon) {
  std::vector<std::int64_t> ends;
  for (const std::int64_t end :
       earlier_slots(newest_end_us, claim.last_slot_end_us, claim.loop.period_s, horizon)) {
    const storage::StoredDigest* row = stored.find(claim.loop.loop_id, end);
    if (row != nullptr && row->same_settings) ends.push_back(end);
  }
  return ends;
}

/// Claimed loops of ONE historian: reads the newest slot of each, in the order of `claims`.
/// Throws storage::DatabaseError.
std::vector<LoopTask> tasks_of(storage::HistorianReader& historian,
                               std::span<const storage::ClaimedLoop* const> claims,
                               const config::Settings& settings, const SourceTime& time,
                               RowMemory& memory, const AnalysisContext& place) {
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const auto start = std::chrono::steady_clock::now();
  const auto slots = newest_slots(
      historian, claims, {settings.schedule.settle_s, time.rule, settings.schedule.catch_up_slots},
      time.now_us);
  std::vector<LoopInput> inputs = read_inputs(historian, slots, settings.analysis, memory, place);
  double reading_ms = Milliseconds(std::chrono::steady_clock::now() - start).count();
  for (const LoopInput& input : inputs) reading_ms -= input.first_look_ms;
  std::vector<LoopTask> tasks;
  for (std::size_t k = 0; k < claims.size(); ++k) {
    tasks.push_back(
        {claims[k], std::move(inputs[k]), {}, reading_ms / static_cast<double>(claims.size())});
  }
  return tasks;
}

/// Loop and slot of everything that the tasks may find stored: the newest slots and `horizon`
/// earlier ones of each loop.
std::vector<std::pair<std::int64_t, std::int64_t>> slots_that_may_be_stored(
    std::span<const LoopTask> tasks, int horizon) {
  std::vector<std::pair<std::int64_t, std::int64_t>> keys;
  for (const LoopTask& task : tasks) {
    const std::int64_t newest = task.newest.at_slot.slot_end_us;
    const storage::ClaimedLoop& claim = *task.claim;
    keys.emplace_back(claim.loop.loop_id, newest);
    for (const std::int64_t end :
         earlier_slots(newest, claim.last_slot_end_us, claim.loop.period_s, horizon)) {
      keys.emplace_back(claim.loop.loop_id, end);
    }
  }
  return keys;
}

/// Earlier slots to look at again, all tasks in one list; `task` says whose each is.
struct EarlierSlots {
  std::vector<LoopSlot> slots;
  std::vector<std::size_t> task;
};

EarlierSlots earlier_slots_to_check(std::span<const LoopTask> tasks, const StoredAnalyses& stored,
                                    int horizon) {
  EarlierSlots earlier;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const LoopWindowAtSlot& newest = tasks[k].newest.at_slot;
    const storage::ClaimedLoop& claim = *tasks[k].claim;
    for (const std::int64_t end : slots_to_check(claim, newest.slot_end_us, stored, horizon)) {
      earlier.slots.push_back({&claim.loop, end, newest.tags, claim.pv_past});
      earlier.task.push_back(k);
    }
  }
  return earlier;
}

/// Reads those slots into their tasks. Throws storage::DatabaseError and leaves them as they were.
void add_earlier(storage::HistorianReader& historian, const EarlierSlots& earlier,
                 const config::Settings& settings, RowMemory& memory, const AnalysisContext& place,
                 std::span<LoopTask> tasks) {
  std::vector<LoopInput> inputs =
      read_inputs(historian, earlier.slots, settings.analysis, memory, place);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    tasks[earlier.task[k]].earlier.push_back(std::move(inputs[k]));
  }
}

/// Notes for the metrics how old the newest row of these loops' tags is, and how many values had a
/// quality that no rule explains. All tasks are of one source.
void note_data(const std::string& source, std::span<const LoopTask> tasks, Metrics& metrics) {
  std::optional<std::int64_t> youngest_us;
  std::size_t unknown = 0;
  for (const LoopTask& task : tasks) {
    for (const TagReading& tag : task.newest.at_slot.tags) {
      unknown += tag.unknown_rows;
      if (!tag.newest_row_us) continue;
      const std::int64_t age_us = tag.asked_us - *tag.newest_row_us;
      youngest_us = std::min(youngest_us.value_or(age_us), age_us);
    }
  }
  if (youngest_us) {
    metrics.data_age(source,
                     static_cast<double>(*youngest_us) / core::signal::kMicrosecondsPerSecond);
  }
  if (unknown > 0) metrics.unknown_quality(source, unknown);
}

}  // namespace

BatchReader::BatchReader(std::shared_ptr<const config::Settings> settings,
                         const std::string& settings_json, SlotRule slot_rule,
                         SharedServices& tools, ProgressBoard::Entry& progress,
                         ResultsLink& results)
    : settings_(std::move(settings)),
      settings_json_(settings_json),
      slot_rule_(slot_rule),
      tools_(tools),
      progress_(progress),
      results_(results) {}

BatchReader::Read BatchReader::read(const std::string& source, const Claims& claims, Batch& batch) {
  Stopwatch watch;
  Read done = read_newest(source, claims, batch);
  double reading_s = watch.lap_s();
  if (done == Read::all) {
    batch.stored = stored_analyses(batch.tasks);
    batch.cost.claim_s += watch.lap_s();
    done = read_earlier(source, claims, batch);
    reading_s += watch.lap_s();
  }
  batch.rows = {};  // the windows hold what is needed of them
  add_reading(reading_s, batch.tasks, batch.cost);
  return done;
}

template <typename Use>
BatchReader::Read BatchReader::with_source(const std::string& source, const Claims& claims,
                                           Batch& batch, Use use) {
  const auto counted_read = [&](storage::HistorianReader& historian) {
    historian.on_statement([&progress = progress_] { progress.step(); });
    return use(historian);
  };
  try {
    const config::HistorianSettings& settings = find_historian(*settings_, source);
    batch.tasks =
        tools_.historians.with_reader(settings, source_terms(settings_->schedule), counted_read);
    tools_.faults.recovered("historian " + source);
    return Read::all;
  } catch (const storage::DatabaseError& error) {
    const bool too_much = error.sqlstate() == kServerOutOfMemory;
    if ((is_row_error(error) || too_much) && claims.size() > 1) return Read::apart;
    if (is_row_error(error)) {
      set_aside(*claims.front(), as_failure(error), batch);
    } else {
      source_is_away(source, as_failure(error), claims, batch);
    }
  } catch (const Failure& failure) {
    source_is_away(source, failure, claims, batch);
  } catch (const std::exception& error) {
    // Out of memory above all: one loop may fit where a batch did not.
    if (claims.size() > 1) return Read::apart;
    set_aside(*claims.front(), as_failure(*claims.front(), error), batch);
  }
  return Read::nothing;
}

BatchReader::Read BatchReader::read_newest(const std::string& source, const Claims& claims,
                                           Batch& batch) {
  const Read done = with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    const SourceTime time = time_of(source, historian);
    std::vector<LoopTask> tasks =
        tasks_of(historian, claims, *settings_, time, batch.rows, {tools_.cores, progress_});
    for (LoopTask& task : tasks) task.by_rows = time.rule != slot_rule_;
    return tasks;
  });
  if (done == Read::all) note_data(source, batch.tasks, tools_.metrics);
  return done;
}

/// Where a historian's clock is wrong nothing but its rows says how far its data go.
SourceTime BatchReader::time_of(const std::string& source, storage::HistorianReader& historian) {
  const storage::ServerClock clock = historian.clock();
  tools_.clocks.note_historian(source, clock);
  return {clock.now_us, tools_.clocks.is_wrong(source) ? SlotRule::newest_sample : slot_rule_};
}

/// Rows that came late for a slot that is stored change its window: a few earlier slots of each
/// loop are looked at again with every analysis.
BatchReader::Read BatchReader::read_earlier(const std::string& source, const Claims& claims,
                                            Batch& batch) {
  const int horizon = settings_->schedule.revise_slots;
  const EarlierSlots earlier = earlier_slots_to_check(batch.tasks, batch.stored, horizon);
  if (earlier.slots.empty()) return Read::all;
  return with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    add_earlier(historian, earlier, *settings_, batch.rows, {tools_.cores, progress_}, batch.tasks);
    return std::move(batch.tasks);
  });
}

StoredAnalyses BatchReader::stored_analyses(const std::vector<LoopTask>& tasks) {
  const auto keys = slots_that_may_be_stored(tasks, settings_->schedule.revise_slots);
  const auto ask = [&](storage::ResultsDatabase& database) {
    return database.stored_digests(keys, core::kAlgorithmRevision, settings_json_);
  };
  return StoredAnalyses(
      results_.with_retry(tools_.perseverance, ask, [this] { progress_.step(); }));
}

void BatchReader::source_is_away(const std::string& source, const Failure& failure,
                                 const Claims& claims, Batch& batch) {
  tools_.faults.fault("historian " + source,
                      std::string(failure.what()) + " HINT: " + failure.hint());
  postpone(claims, failure, source_pause_s(settings_->schedule), batch);
}

}  // namespace loopscope::daemon
