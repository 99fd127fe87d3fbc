// The part of a lane that reads: what the batch needs out of its historian, and what is to be done
// when that fails.
#include <algorithm>
#include <chrono>
#include <spdlog/spdlog.h>
#include <utility>

#include "daemon/service/batch_cost.hpp"
#include "daemon/service/blame.hpp"
#include "daemon/service/data_age.hpp"
#include "daemon/service/lane.hpp"
#include "daemon/service/stopwatch.hpp"
#include "daemon/service/storage_settings.hpp"

namespace loopscope::daemon {
namespace {

using storage::ClaimedLoop;

/// Longer than any batch of windows takes to read: whoever has not got a connection by then is
/// better off with other loops.
constexpr double kPatience_s = 30.0;
/// The wait for a connection takes at most this share of the lease: the rest is for the work.
constexpr double kPatienceOfLease = 1.0 / 3.0;
/// A historian that failed is left alone for so long, and for a poll at most, so that its loops go
/// on soon after it is back.
constexpr double kSourcePause_s = 30.0;

double source_pause_s(const config::ScheduleSettings& schedule) {
  return std::min(kSourcePause_s, schedule.poll_s);
}

SourceTerms terms(const config::ScheduleSettings& schedule) {
  const auto duration = [](double seconds) {
    return std::chrono::duration_cast<SourceGate::Duration>(std::chrono::duration<double>(seconds));
  };
  return {duration(std::min(kPatience_s, kPatienceOfLease * schedule.lease_s)),
          duration(source_pause_s(schedule)), schedule.lease_s};
}

}  // namespace

Lane::Fetched Lane::fetch(const std::string& source, const Claims& claims, Batch& batch) {
  Stopwatch watch;
  Fetched fetched = read_newest(source, claims, batch);
  double reading_s = watch.lap_s();
  if (fetched == Fetched::all) {
    batch.stored = stored_analyses(batch.visits);
    batch.cost.claim_s += watch.lap_s();
    fetched = read_earlier(source, claims, batch);
    reading_s += watch.lap_s();
  }
  batch.rows = {};  // the windows hold what is needed of them
  add_reading(reading_s, batch.visits, batch.cost);
  return fetched;
}

template <typename Read>
Lane::Fetched Lane::with_source(const std::string& source, const Claims& claims, Batch& batch,
                                Read read) {
  const auto counted_read = [&](storage::HistorianReader& historian) {
    historian.on_statement([&desk = desk_] { desk.step(); });
    return read(historian);
  };
  try {
    const config::HistorianSettings& settings = find_historian(*settings_, source);
    batch.visits =
        tools_.historians.with_reader(settings, terms(settings_->schedule), counted_read);
    tools_.faults.recovered("historian " + source);
    return Fetched::all;
  } catch (const storage::DatabaseError& error) {
    if (speaks_of_rows(error) && claims.size() > 1) return Fetched::apart;
    if (speaks_of_rows(error)) {
      set_aside(*claims.front(), as_failure(error), batch);
    } else {
      postpone(source, as_failure(error), claims, batch);
    }
  } catch (const Failure& failure) {
    postpone(source, failure, claims, batch);
  } catch (const std::exception& error) {
    // Out of memory above all: one loop may fit where a batch did not.
    if (claims.size() > 1) return Fetched::apart;
    set_aside(*claims.front(), as_failure(*claims.front(), error), batch);
  }
  return Fetched::nothing;
}

Lane::Fetched Lane::read_newest(const std::string& source, const Claims& claims, Batch& batch) {
  const Fetched fetched =
      with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
        return visit_newest(historian, claims, *settings_, slot_rule_, batch.rows,
                            {tools_.cores, desk_});
      });
  if (fetched == Fetched::all) note_data(source, batch.visits, tools_.metrics);
  return fetched;
}

/// Rows that came late for a slot that is stored change its window: a few earlier slots of each
/// loop are looked at again with every visit.
Lane::Fetched Lane::read_earlier(const std::string& source, const Claims& claims, Batch& batch) {
  const int horizon = settings_->schedule.revise_slots;
  const EarlierSlots earlier = earlier_slots_to_check(batch.visits, batch.stored, horizon);
  if (earlier.slots.empty()) return Fetched::all;
  return with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    visit_earlier(historian, earlier, *settings_, batch.rows, {tools_.cores, desk_}, batch.visits);
    return std::move(batch.visits);
  });
}

StoredAnalyses Lane::stored_analyses(const std::vector<LoopVisit>& visits) {
  const auto keys = slots_that_may_be_stored(visits, settings_->schedule.revise_slots);
  return StoredAnalyses(persistently([&](storage::ResultsDatabase& database) {
    return database.stored_digests(keys, core::kAlgorithmRevision, settings_json_);
  }));
}

void Lane::postpone(const std::string& source, const Failure& failure, const Claims& claims,
                    Batch& batch) {
  tools_.faults.fault("historian " + source,
                      std::string(failure.what()) + " HINT: " + failure.hint());
  if (!first_failure_) first_failure_ = failure;
  const double pause_s = source_pause_s(settings_->schedule);
  for (const ClaimedLoop* claim : claims) {
    batch.failed.push_back({claim->loop.loop_id, claim->fence, failure.what(), pause_s, false});
  }
}

void Lane::set_aside(const ClaimedLoop& claim, const Failure& failure, Batch& batch) {
  const double pause_s = retry_pause_s(claim.attempts);
  spdlog::error("loop \"{}\" is set aside for {:.0f} s: {} HINT: {}", claim.loop.name, pause_s,
                failure.what(), failure.hint());
  if (!first_failure_) first_failure_ = failure;
  batch.failed.push_back({claim.loop.loop_id, claim.fence, failure.what(), pause_s});
}

}  // namespace loopscope::daemon
