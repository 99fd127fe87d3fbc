#include "daemon/service/batches/batch_reader.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "core/signal/microseconds.hpp"
#include "daemon/service/batches/slots_to_check.hpp"
#include "daemon/service/historians/source_gate.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/windows/loop_slot.hpp"

namespace loopscope::daemon {
namespace {

/// SQLSTATE: one loop may fit where a batch did not.
constexpr const char* kServerOutOfMemory = "53200";

std::size_t values_in(const LoopInput& input) {
  const core::signal::LoopWindow& window = input.at_slot.window;
  return window.sp.size() + window.pv.size() + window.op.size() + window.mv.size();
}

std::size_t values_in(std::span<const LoopTask> tasks) {
  std::size_t values = 0;
  for (const LoopTask& task : tasks) {
    values += values_in(task.newest);
    for (const LoopInput& input : task.earlier) values += values_in(input);
  }
  return values;
}

/// Notes for the metrics how old the newest row of these loops' tags is, and how many values had a
/// quality that no rule explains. All are of one source.
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

/// A worker claims its loops for their newest slots, or all of them for slots of the past.
bool of_the_past(const Claims& claims) {
  return claims.front()->past.has_value();
}

LoopTask* find_task(std::vector<LoopTask>& tasks, const storage::ClaimedLoop* claim) {
  const auto found = std::ranges::find(tasks, claim, &LoopTask::claim);
  return found == tasks.end() ? nullptr : &*found;
}

}  // namespace

BatchReader::BatchReader(std::shared_ptr<const config::Settings> settings,
                         const std::string& settings_json, SlotRule slot_rule,
                         SharedServices& tools, ProgressBoard::Entry& progress,
                         ResultsLink& results, StageDriver& driver)
    : settings_(std::move(settings)),
      settings_json_(settings_json),
      slot_rule_(slot_rule),
      tools_(tools),
      progress_(progress),
      results_(results),
      driver_(driver) {}

BatchReader::Read BatchReader::read(const std::string& source, const Claims& claims, Batch& batch) {
  const double fetched_before_s = driver_.cost().fetch_s;
  Read done = read_newest(source, claims, batch);
  if (done == Read::all && !of_the_past(claims)) {
    note_data(source, batch.tasks, tools_.metrics);
    done = read_earlier(source, claims, batch);
  }
  if (done == Read::all) driver_.cost().values += values_in(batch.tasks);
  if (batch.kept.keep_nothing()) batch.rows = {};  // the windows hold what is needed of them
  const double fetch_ms = 1e3 * (driver_.cost().fetch_s - fetched_before_s);
  for (LoopTask& task : batch.tasks) {
    task.fetch_ms = fetch_ms / static_cast<double>(claims.size());
  }
  return done;
}

template <typename Use>
BatchReader::Read BatchReader::with_source(const std::string& source, const Claims& claims,
                                           Batch& batch, Use use) {
  const auto counted_use = [&](storage::HistorianReader& historian) {
    historian.on_statement([&progress = progress_] { progress.step(); });
    use(historian);
    return true;
  };
  try {
    driver_.run(&storage::StageCost::fetch_s, [&] {
      return tools_.historians.with_reader(find_historian(*settings_, source),
                                           source_terms(settings_->schedule), counted_use);
    });
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
  std::vector<LoopSlot> slots;
  bool by_rows = false;
  Read done = with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    const SourceTime time = time_of(source, historian);
    by_rows = time.rule != slot_rule_;
    slots = slots_of(claims, time, historian);
  });
  if (done != Read::all) return done;
  if (!of_the_past(claims)) {
    batch.stored =
        driver_.run(&storage::StageCost::claim_s, [&] { return stored_analyses(claims, slots); });
    batch.kept.use(claims, slots, batch.stored, batch.rows);
  }
  std::vector<LoopWindowAtSlot> windows;
  done = with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    windows = windows_of(historian, slots, batch);
  });
  if (done != Read::all) return done;
  batch.kept.compare(batch.rows);
  prepare(claims, std::move(windows), batch,
          [&](const storage::ClaimedLoop* claim, LoopInput input) {
            batch.tasks.push_back({claim, std::move(input), {}, 0.0, by_rows});
          });
  std::vector<InputOfLoop> inputs;
  for (LoopTask& task : batch.tasks) inputs.push_back({&task.claim->loop, &task.newest});
  return read_longer(source, claims, batch, inputs);
}

std::vector<LoopSlot> BatchReader::slots_of(const Claims& claims, const SourceTime& time,
                                            storage::HistorianReader& historian) const {
  if (of_the_past(claims)) return claimed_past_slots(historian, claims);
  const config::ScheduleSettings& schedule = settings_->schedule;
  const SlotSettings wanted{schedule.settle_s, time.rule, schedule.catch_up_slots};
  return newest_slots(historian, claims, wanted, time.now_us);
}

std::vector<LoopWindowAtSlot> BatchReader::windows_of(storage::HistorianReader& historian,
                                                      std::span<const LoopSlot> slots,
                                                      Batch& batch) {
  return read_windows(historian, slots, settings_->analysis.prepare.window_samples, batch.rows);
}

/// Needs no connection, but a core. A loop whose window cannot be prepared is set aside.
template <typename Keep>
void BatchReader::prepare(const Claims& of_windows, std::vector<LoopWindowAtSlot> windows,
                          Batch& batch, Keep keep) {
  using storage::StageCost;
  const CoreGate::Permit core =
      driver_.run(&StageCost::wait_s, [&] { return take_core(tools_.cores, progress_); });
  for (std::size_t k = 0; k < windows.size(); ++k) {
    const storage::ClaimedLoop* claim = of_windows[k];
    if (is_set_aside(claim->loop.loop_id, batch)) continue;
    try {
      LoopInput input = driver_.run(&StageCost::prepare_s, [&] {
        return prepare_input(std::move(windows[k]), settings_->analysis);
      });
      input.prepare_ms = driver_.last_ms();
      keep(claim, std::move(input));
    } catch (const std::exception& error) {
      set_aside(*claim, as_failure(*claim, error), batch);
      std::erase_if(batch.tasks, [&](const LoopTask& task) { return task.claim == claim; });
    }
  }
}

BatchReader::Read BatchReader::read_longer(const std::string& source, const Claims& claims,
                                           Batch& batch, std::span<const InputOfLoop> inputs) {
  if (std::ranges::none_of(inputs, &InputOfLoop::wants_longer_span)) return Read::all;
  return with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    read_longer_spans(historian, inputs, batch.rows);
  });
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
  const EarlierSlots earlier = earlier_slots_to_check(batch, horizon);
  if (earlier.slots.empty()) return Read::all;
  std::vector<LoopWindowAtSlot> windows;
  const Read done = with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    windows = windows_of(historian, earlier.slots, batch);
  });
  if (done != Read::all) return done;
  prepare(earlier.claims, std::move(windows), batch,
          [&](const storage::ClaimedLoop* claim, LoopInput input) {
            find_task(batch.tasks, claim)->earlier.push_back(std::move(input));
          });
  std::vector<InputOfLoop> inputs;
  for (LoopTask& task : batch.tasks) {
    for (LoopInput& input : task.earlier) inputs.push_back({&task.claim->loop, &input});
  }
  return read_longer(source, claims, batch, inputs);
}

StoredAnalyses BatchReader::stored_analyses(const Claims& claims, std::span<const LoopSlot> slots) {
  const auto keys = slots_that_may_be_stored(claims, slots, settings_->schedule.revise_slots);
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
