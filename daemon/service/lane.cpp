#include "daemon/service/lane.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <spdlog/spdlog.h>
#include <utility>

#include "config/read_settings.hpp"
#include "daemon/failure.hpp"
#include "daemon/service/batch_cost.hpp"
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

SourceGate::Duration patience(const config::ScheduleSettings& schedule) {
  return std::chrono::duration_cast<SourceGate::Duration>(
      std::chrono::duration<double>(std::min(kPatience_s, kPatienceOfLease * schedule.lease_s)));
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
      tools_(tools) {}

storage::ResultsDatabase& Lane::results() {
  if (results_) return *results_;
  results_.emplace(results_connection(*settings_));
  // The views flag loops by these; they follow the settings of the worker that connected last.
  results_->set_parameter("false_discovery_rate", settings_->flags.false_discovery_rate);
  results_->set_parameter("false_discovery_dependence",
                          settings_->flags.false_discovery_dependence == "arbitrary" ? 1.0 : 0.0);
  results_->set_parameter("min_confidence", settings_->flags.min_confidence);
  return *results_;
}

template <typename Claim>
std::vector<ClaimedLoop> Lane::timed_claim(Claim claim) {
  Stopwatch watch;
  std::vector<ClaimedLoop> claims = with_results(claim);
  if (!claims.empty()) costs_.add({.claim_s = watch.lap_s()});
  return claims;
}

std::vector<ClaimedLoop> Lane::claim_due() {
  const config::ScheduleSettings& schedule = settings_->schedule;
  return timed_claim([&](storage::ResultsDatabase& database) {
    return database.claim_due(owner_, schedule.lease_s, schedule.batch_loops);
  });
}

std::vector<ClaimedLoop> Lane::claim_next(std::int64_t after) {
  const config::ScheduleSettings& schedule = settings_->schedule;
  return timed_claim([&](storage::ResultsDatabase& database) {
    return database.claim_next(owner_, schedule.lease_s, schedule.batch_loops, after);
  });
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
  storage::WriteCount sum;
  for (const auto& [source, loops] : by_source(claims)) add(sum, process_source(source, loops));
  store_cost(costs_.take(false));
  return sum;
}

storage::WriteCount Lane::process_source(const std::string& source, const Claims& claims) {
  Batch batch;
  batch.cost.loops = claims.size();
  if (fetch(source, claims, batch)) analyse(batch);
  return write(batch);
}

bool Lane::fetch(const std::string& source, const Claims& claims, Batch& batch) {
  Stopwatch watch;
  bool fetched = read_newest(source, claims, batch);
  double reading_s = watch.lap_s();
  if (fetched) {
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
bool Lane::with_source(const std::string& source, const Claims& claims, Batch& batch, Read read) {
  try {
    const config::HistorianSettings& settings = find_historian(*settings_, source);
    batch.visits = tools_.historians.with_reader(settings, patience(settings_->schedule), read);
    tools_.faults.recovered("historian " + source);
    return true;
  } catch (const storage::DatabaseError& error) {
    set_aside(source, {ExitCode::database, error.what(), error.hint()}, claims, batch);
  } catch (const Failure& failure) {
    set_aside(source, failure, claims, batch);
  }
  return false;
}

bool Lane::read_newest(const std::string& source, const Claims& claims, Batch& batch) {
  return with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    return visit_newest(historian, claims, *settings_, slot_rule_, batch.rows, tools_.cores);
  });
}

/// Rows that came late for a slot that is stored change its window: a few earlier slots of each
/// loop are looked at again with every visit.
bool Lane::read_earlier(const std::string& source, const Claims& claims, Batch& batch) {
  const int horizon = settings_->schedule.revise_slots;
  const EarlierSlots earlier = earlier_slots_to_check(batch.visits, batch.stored, horizon);
  if (earlier.slots.empty()) return true;
  return with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    visit_earlier(historian, earlier, *settings_, batch.rows, tools_.cores, batch.visits);
    return std::move(batch.visits);
  });
}

StoredAnalyses Lane::stored_analyses(const std::vector<LoopVisit>& visits) {
  const auto keys = slots_that_may_be_stored(visits, settings_->schedule.revise_slots);
  return StoredAnalyses(with_results([&](storage::ResultsDatabase& database) {
    return database.stored_digests(keys, core::kAlgorithmRevision, settings_json_);
  }));
}

void Lane::set_aside(const std::string& source, const Failure& failure, const Claims& claims,
                     Batch& batch) {
  tools_.faults.fault("historian " + source,
                      std::string(failure.what()) + " HINT: " + failure.hint());
  if (!first_failure_) first_failure_ = failure;
  constexpr std::chrono::duration<double> kPause = kSourcePause;
  for (const ClaimedLoop* claim : claims) {
    batch.failed.push_back({claim->loop.loop_id, claim->fence, failure.what(), kPause.count()});
  }
}

void Lane::analyse(Batch& batch) {
  const AnalysisOrders orders{*settings_, settings_json_, enabled_loops()};
  Stopwatch watch;
  const CoreGate::Permit core(tools_.cores);
  batch.cost.wait_s += watch.lap_s();
  for (const LoopVisit& visit : batch.visits) complete(visit, orders, batch);
  batch.visits.clear();
  add_analyses(watch.lap_s(), batch.completed, batch.cost);
}

void Lane::complete(const LoopVisit& visit, const AnalysisOrders& orders, Batch& batch) {
  const ClaimedLoop& claim = *visit.claim;
  try {
    batch.completed.push_back(complete_visit(visit, batch.stored, orders));
  } catch (const std::exception& error) {
    spdlog::error("loop \"{}\" could not be analysed: {}", claim.loop.name, error.what());
    if (!first_failure_) {
      first_failure_ = Failure(ExitCode::fault, "loop \"" + claim.loop.name + "\": " + error.what(),
                               "this is a fault in the program: please report it");
    }
    batch.failed.push_back(
        {claim.loop.loop_id, claim.fence, error.what(), retry_pause_s(claim.attempts)});
  }
}

storage::WriteCount Lane::write(Batch& batch) {
  Stopwatch watch;
  const storage::WriteCount count = with_results([&](storage::ResultsDatabase& database) {
    return database.finish(batch.completed, batch.failed);
  });
  batch.cost.write_s += watch.lap_s();
  costs_.add(batch.cost);
  return count;
}

/// Counted anew now and then: the catalogue changes slowly.
std::size_t Lane::enabled_loops() {
  const Clock::time_point now = Clock::now();
  if (!counted_at_ || now - *counted_at_ > kCountEvery) {
    enabled_loops_ = with_results(
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
    with_results([&](storage::ResultsDatabase& database) {
      database.add_stage_cost({host_name(), static_cast<int>(index_)}, *cost);
    });
    tools_.faults.recovered("record of costs");
  } catch (const storage::DatabaseError& error) {
    costs_.put_back(*cost);
    tools_.faults.fault("record of costs", std::string(error.what()) + " HINT: " + error.hint());
  }
}

}  // namespace loopscope::daemon
