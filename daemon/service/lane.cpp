#include "daemon/service/lane.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <spdlog/spdlog.h>
#include <utility>

#include "config/read_settings.hpp"
#include "daemon/failure.hpp"
#include "daemon/service/batch_cost.hpp"
#include "daemon/service/blame.hpp"
#include "daemon/service/data_age.hpp"
#include "daemon/service/stopwatch.hpp"
#include "daemon/service/storage_settings.hpp"
#include "daemon/service/workforce.hpp"

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

Failure as_failure(const storage::DatabaseError& error) {
  return {ExitCode::database, error.what(), error.hint()};
}

Failure as_failure(const storage::ClaimedLoop& claim, const std::exception& error) {
  return {ExitCode::fault, "loop \"" + claim.loop.name + "\": " + error.what(),
          "this is a fault in the program: please report it"};
}

constexpr std::chrono::minutes kCountEvery{5};

}  // namespace

Lane::Lane(std::shared_ptr<const config::Settings> settings, std::size_t index, SlotRule slot_rule,
           LaneTools& tools)
    : settings_(std::move(settings)),
      settings_json_(config::analysis_settings_json(settings_->analysis)),
      index_(index),
      owner_(worker_name(index)),
      slot_rule_(slot_rule),
      tools_(tools),
      desk_(tools.progress.desk()),
      results_(settings_, tools.faults, tools.metrics, tools.bell) {}

template <typename Claim>
std::vector<ClaimedLoop> Lane::timed_claim(Claim claim) {
  Stopwatch watch;
  std::vector<ClaimedLoop> claims = results_.with(claim);
  desk_.hold(claims);
  const storage::StageCost cost{.claim_s = watch.lap_s()};
  if (!claims.empty()) {
    costs_.add(cost);
    tools_.metrics.add(cost);
  }
  return claims;
}

template <typename Use>
auto Lane::persistently(Use use) {
  return results_.persistently(tools_.perseverance, use, [this] { desk_.step(); });
}

std::vector<ClaimedLoop> Lane::claim_due() {
  const config::ScheduleSettings& schedule = settings_->schedule;
  return timed_claim([&](storage::ResultsDatabase& database) {
    return database.claim_due(owner_, schedule.lease_s, schedule.batch_loops);
  });
}

std::vector<ClaimedLoop> Lane::claim_suspect() {
  suspect_turn_ = std::unique_lock(tools_.suspect_turn, std::try_to_lock);
  if (!suspect_turn_) return {};
  std::vector<ClaimedLoop> claims = timed_claim([&](storage::ResultsDatabase& database) {
    return database.claim_suspect(owner_, settings_->schedule.lease_s);
  });
  if (claims.empty()) suspect_turn_ = {};
  return claims;
}

std::vector<ClaimedLoop> Lane::claim_next(std::int64_t after) {
  const config::ScheduleSettings& schedule = settings_->schedule;
  return timed_claim([&](storage::ResultsDatabase& database) {
    return database.claim_next(owner_, schedule.lease_s, schedule.batch_loops, after);
  });
}

std::optional<double> Lane::next_due_in_s() {
  return results_.with([](storage::ResultsDatabase& database) { return database.next_due_in_s(); });
}

/// Loops grouped by historian, the one with the fewest users first. One that was down a moment ago
/// comes last: what it costs to find that it still is must not hold up the loops of others.
std::vector<std::pair<std::string, Lane::Claims>> Lane::by_source(
    const std::vector<ClaimedLoop>& claims) {
  std::map<std::string, Claims> groups;
  for (const ClaimedLoop& claim : claims) groups[claim.loop.source].push_back(&claim);
  std::multimap<std::pair<bool, int>, std::string> by_burden;
  for (const auto& [source, group] : groups) {
    by_burden.insert(
        {{tools_.historians.is_down(source), tools_.historians.in_use(source)}, source});
  }
  std::vector<std::pair<std::string, Claims>> ordered;
  for (const auto& [burden, source] : by_burden) {
    ordered.emplace_back(source, std::move(groups[source]));
  }
  return ordered;
}

storage::WriteCount Lane::process(const std::vector<ClaimedLoop>& claims) {
  /// Whatever happens, nothing is held afterwards.
  struct Clear {
    Lane& lane;
    ~Clear() {
      lane.desk_.drop();
      lane.suspect_turn_ = {};
    }
  } const clear{*this};
  Stopwatch watch;
  storage::WriteCount sum;
  for (const auto& [source, loops] : by_source(claims)) add(sum, process_source(source, loops));
  tools_.metrics.count(sum);
  tools_.metrics.observe_batch(watch.lap_s());
  store_cost(costs_.take(false));
  return sum;
}

storage::WriteCount Lane::process_source(const std::string& source, const Claims& claims) {
  Batch batch;
  batch.cost.loops = claims.size();
  const Fetched fetched = fetch(source, claims, batch);
  if (fetched == Fetched::apart) {
    storage::WriteCount sum;
    for (const ClaimedLoop* claim : claims) add(sum, process_source(source, {claim}));
    return sum;
  }
  const std::size_t lost = fetched == Fetched::all ? analyse(batch) : 0;
  storage::WriteCount count = write(claims, batch);
  count.fenced_off += lost;
  return count;
}

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

std::size_t Lane::analyse(Batch& batch) {
  const AnalysisOrders orders{*settings_, settings_json_, enabled_loops()};
  Stopwatch watch;
  const CoreGate::Permit core = take_core({tools_.cores, desk_});
  batch.cost.wait_s += watch.lap_s();
  std::size_t lost = 0;
  for (const LoopVisit& visit : batch.visits) {
    if (desk_.lost(visit.claim->loop.loop_id)) {
      ++lost;
    } else {
      complete(visit, orders, batch);
    }
    desk_.step();
  }
  batch.visits.clear();
  add_analyses(watch.lap_s(), batch.completed, batch.cost);
  return lost;
}

void Lane::complete(const LoopVisit& visit, const AnalysisOrders& orders, Batch& batch) {
  try {
    batch.completed.push_back(complete_visit(visit, batch.stored, orders));
  } catch (const std::exception& error) {
    set_aside(*visit.claim, as_failure(*visit.claim, error), batch);
  }
}

storage::WriteCount Lane::write(const Claims& claims, Batch& batch) {
  Stopwatch watch;
  storage::WriteCount count;
  try {
    count = finish(batch.completed, batch.failed);
  } catch (const storage::DatabaseError& error) {
    if (!speaks_of_rows(error)) throw;
    count = write_one_by_one(claims, batch);
  }
  batch.cost.write_s += watch.lap_s();
  costs_.add(batch.cost);
  tools_.metrics.add(batch.cost);
  return count;
}

/// One loop's row is refused, and with it the whole transaction: the others do without it.
storage::WriteCount Lane::write_one_by_one(const Claims& claims, Batch& batch) {
  storage::WriteCount sum;
  for (const storage::CompletedLoop& loop : std::exchange(batch.completed, {})) {
    try {
      add(sum, finish({loop}, {}));
    } catch (const storage::DatabaseError& error) {
      if (!speaks_of_rows(error)) throw;
      const auto claim = std::ranges::find(
          claims, loop.loop_id, [](const ClaimedLoop* held) { return held->loop.loop_id; });
      set_aside(**claim, as_failure(error), batch);
    }
  }
  add(sum, finish({}, batch.failed));
  return sum;
}

storage::WriteCount Lane::finish(const std::vector<storage::CompletedLoop>& completed,
                                 const std::vector<storage::FailedLoop>& failed) {
  return persistently(
      [&](storage::ResultsDatabase& database) { return database.finish(completed, failed); });
}

/// Counted anew now and then: the catalogue changes slowly.
std::size_t Lane::enabled_loops() {
  const Clock::time_point now = Clock::now();
  if (!counted_at_ || now - *counted_at_ > kCountEvery) {
    enabled_loops_ = persistently(
        [](storage::ResultsDatabase& database) { return database.count_enabled_loops(); });
    counted_at_ = now;
  }
  return enabled_loops_;
}

void Lane::store_cost() {
  store_cost(costs_.take(true));
}

/// The record of costs is worth less than the work: without it, that goes on.
void Lane::store_cost(const std::optional<storage::StageCost>& cost) {
  if (!cost) return;
  try {
    results_.with([&](storage::ResultsDatabase& database) {
      database.add_stage_cost({host_name(), static_cast<int>(index_)}, *cost);
      return true;
    });
    tools_.faults.recovered("record of costs");
  } catch (const storage::DatabaseError& error) {
    costs_.put_back(*cost);
    tools_.faults.fault("record of costs", std::string(error.what()) + " HINT: " + error.hint());
  }
}

}  // namespace loopscope::daemon
