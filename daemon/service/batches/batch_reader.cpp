#include "daemon/service/batches/batch_reader.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "daemon/service/batches/batch_cost.hpp"
#include "daemon/service/batches/data_age.hpp"
#include "daemon/service/batches/fetch_windows.hpp"
#include "daemon/service/historians/source_terms.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/observe/error_scope.hpp"
#include "daemon/service/observe/stopwatch.hpp"

namespace loopscope::daemon {
namespace {

/// SQLSTATE: one loop may fit where a batch did not.
constexpr const char* kServerOutOfMemory = "53200";

}  // namespace

BatchReader::BatchReader(std::shared_ptr<const config::Settings> settings,
                         const std::string& settings_json, SlotRule slot_rule,
                         SharedServices& tools, ProgressBoard::Entry& desk, ResultsLink& results)
    : settings_(std::move(settings)),
      settings_json_(settings_json),
      slot_rule_(slot_rule),
      tools_(tools),
      desk_(desk),
      results_(results) {}

BatchReader::Read BatchReader::read(const std::string& source, const Claims& claims, Batch& batch) {
  Stopwatch watch;
  Read done = read_newest(source, claims, batch);
  double reading_s = watch.lap_s();
  if (done == Read::all) {
    batch.stored = stored_analyses(batch.visits);
    batch.cost.claim_s += watch.lap_s();
    done = read_earlier(source, claims, batch);
    reading_s += watch.lap_s();
  }
  batch.rows = {};  // the windows hold what is needed of them
  add_reading(reading_s, batch.visits, batch.cost);
  return done;
}

template <typename Visit>
BatchReader::Read BatchReader::with_source(const std::string& source, const Claims& claims,
                                           Batch& batch, Visit visit) {
  const auto counted_read = [&](storage::HistorianReader& historian) {
    historian.on_statement([&desk = desk_] { desk.step(); });
    return visit(historian);
  };
  try {
    const config::HistorianSettings& settings = find_historian(*settings_, source);
    batch.visits =
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
    std::vector<LoopTask> visits =
        visit_newest(historian, claims, *settings_, time, batch.rows, {tools_.cores, desk_});
    for (LoopTask& visit : visits) visit.by_rows = time.rule != slot_rule_;
    return visits;
  });
  if (done == Read::all) note_data(source, batch.visits, tools_.metrics);
  return done;
}

/// Where a historian's clock is wrong nothing but its rows says how far its data go.
SourceTime BatchReader::time_of(const std::string& source, storage::HistorianReader& historian) {
  const storage::ServerClock clock = historian.clock();
  tools_.clocks.note_historian(source, clock);
  return {clock.now_us, tools_.clocks.is_wrong(source) ? SlotRule::newest_sample : slot_rule_};
}

/// Rows that came late for a slot that is stored change its window: a few earlier slots of each
/// loop are looked at again with every visit.
BatchReader::Read BatchReader::read_earlier(const std::string& source, const Claims& claims,
                                            Batch& batch) {
  const int horizon = settings_->schedule.revise_slots;
  const EarlierSlots earlier = earlier_slots_to_check(batch.visits, batch.stored, horizon);
  if (earlier.slots.empty()) return Read::all;
  return with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    visit_earlier(historian, earlier, *settings_, batch.rows, {tools_.cores, desk_}, batch.visits);
    return std::move(batch.visits);
  });
}

StoredAnalyses BatchReader::stored_analyses(const std::vector<LoopTask>& visits) {
  const auto keys = slots_that_may_be_stored(visits, settings_->schedule.revise_slots);
  const auto ask = [&](storage::ResultsDatabase& database) {
    return database.stored_digests(keys, core::kAlgorithmRevision, settings_json_);
  };
  return StoredAnalyses(results_.with_retry(tools_.perseverance, ask, [this] { desk_.step(); }));
}

void BatchReader::source_is_away(const std::string& source, const Failure& failure,
                                 const Claims& claims, Batch& batch) {
  tools_.faults.fault("historian " + source,
                      std::string(failure.what()) + " HINT: " + failure.hint());
  postpone(claims, failure, source_pause_s(settings_->schedule), batch);
}

}  // namespace loopscope::daemon
