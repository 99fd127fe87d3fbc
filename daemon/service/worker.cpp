#include "daemon/service/worker.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <spdlog/spdlog.h>
#include <utility>

#include "config/read_settings.hpp"
#include "daemon/failure.hpp"
#include "daemon/service/newest_slots.hpp"
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

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

SourceGate::Duration patience(const config::ScheduleSettings& schedule) {
  return std::chrono::duration_cast<SourceGate::Duration>(
      std::chrono::duration<double>(std::min(kPatience_s, kPatienceOfLease * schedule.lease_s)));
}

}  // namespace

Worker::Worker(std::shared_ptr<const config::Settings> settings, std::string owner,
               SlotRule slot_rule, FaultLog& faults, HistorianPool& historians)
    : settings_(std::move(settings)),
      settings_json_(config::analysis_settings_json(settings_->analysis)),
      owner_(std::move(owner)),
      slot_rule_(slot_rule),
      faults_(faults),
      historians_(historians) {}

storage::ResultsDatabase& Worker::results() {
  if (results_) return *results_;
  results_.emplace(results_connection(*settings_));
  // The views flag loops by these; they follow the settings of the worker that connected last.
  results_->set_parameter("false_discovery_rate", settings_->flags.false_discovery_rate);
  results_->set_parameter("false_discovery_dependence",
                          settings_->flags.false_discovery_dependence == "arbitrary" ? 1.0 : 0.0);
  results_->set_parameter("min_confidence", settings_->flags.min_confidence);
  return *results_;
}

std::vector<ClaimedLoop> Worker::claim_due() {
  const config::ScheduleSettings& schedule = settings_->schedule;
  return with_results([&](storage::ResultsDatabase& database) {
    return database.claim_due(owner_, schedule.lease_s, schedule.batch_loops);
  });
}

std::vector<ClaimedLoop> Worker::claim_next(std::int64_t after) {
  const config::ScheduleSettings& schedule = settings_->schedule;
  return with_results([&](storage::ResultsDatabase& database) {
    return database.claim_next(owner_, schedule.lease_s, schedule.batch_loops, after);
  });
}

/// Loops grouped by historian. One that was down a moment ago comes last: what it costs to find
/// that it still is must not hold up the loops of others.
std::vector<std::pair<std::string, Worker::Claims>> Worker::by_source(
    const std::vector<ClaimedLoop>& claims) {
  std::map<std::pair<bool, std::string>, Claims> groups;
  for (const ClaimedLoop& claim : claims) {
    groups[{historians_.is_down(claim.loop.source), claim.loop.source}].push_back(&claim);
  }
  std::vector<std::pair<std::string, Claims>> ordered;
  for (auto& [key, group] : groups) ordered.emplace_back(key.second, std::move(group));
  return ordered;
}

storage::WriteCount Worker::process(const std::vector<ClaimedLoop>& claims) {
  storage::WriteCount sum;
  for (const auto& [source, loops] : by_source(claims)) add(sum, process_source(source, loops));
  return sum;
}

storage::WriteCount Worker::process_source(const std::string& source, const Claims& claims) {
  Batch batch;
  if (read_newest(source, claims, batch)) {
    batch.stored = stored_analyses(batch.visits);
    if (read_earlier(source, claims, batch)) analyse(batch);
  }
  return with_results([&](storage::ResultsDatabase& database) {
    return database.finish(batch.completed, batch.failed);
  });
}

template <typename Read>
bool Worker::with_source(const std::string& source, const Claims& claims, Batch& batch, Read read) {
  try {
    const config::HistorianSettings& settings = find_historian(*settings_, source);
    batch.visits = historians_.with_reader(settings, patience(settings_->schedule), read);
    faults_.recovered("historian " + source);
    return true;
  } catch (const storage::DatabaseError& error) {
    set_aside(source, {ExitCode::database, error.what(), error.hint()}, claims, batch);
  } catch (const Failure& failure) {
    set_aside(source, failure, claims, batch);
  }
  return false;
}

bool Worker::read_newest(const std::string& source, const Claims& claims, Batch& batch) {
  return with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    const auto start = std::chrono::steady_clock::now();
    const auto slots = newest_slots(historian, claims, {settings_->schedule.settle_s, slot_rule_});
    std::vector<LoopInput> inputs = read_inputs(historian, slots, settings_->analysis, batch.rows);
    double reading_ms = milliseconds_since(start);
    for (const LoopInput& input : inputs) reading_ms -= input.first_look_ms;
    std::vector<LoopVisit> visits;
    for (std::size_t k = 0; k < claims.size(); ++k) {
      visits.push_back(
          {claims[k], std::move(inputs[k]), {}, reading_ms / static_cast<double>(claims.size())});
    }
    return visits;
  });
}

/// Rows that came late for a slot that is stored change its window: a few earlier slots of each
/// loop are read again with every visit.
bool Worker::read_earlier(const std::string& source, const Claims& claims, Batch& batch) {
  std::vector<LoopSlot> slots;
  std::vector<std::size_t> owner;
  for (std::size_t k = 0; k < batch.visits.size(); ++k) {
    const LoopWindowAtSlot& newest = batch.visits[k].newest.at_slot;
    const ClaimedLoop& claim = *batch.visits[k].claim;
    for (const std::int64_t end : slots_to_check(claim, newest.slot_end_us, batch.stored,
                                                 settings_->schedule.revise_slots)) {
      slots.push_back({&claim.loop, end, newest.tags});
      owner.push_back(k);
    }
  }
  if (slots.empty()) return true;
  return with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    std::vector<LoopInput> inputs = read_inputs(historian, slots, settings_->analysis, batch.rows);
    std::vector<LoopVisit> visits = std::move(batch.visits);
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      visits[owner[k]].earlier.push_back(std::move(inputs[k]));
    }
    return visits;
  });
}

StoredAnalyses Worker::stored_analyses(const std::vector<LoopVisit>& visits) {
  std::vector<std::pair<std::int64_t, std::int64_t>> keys;
  for (const LoopVisit& visit : visits) {
    const std::int64_t newest = visit.newest.at_slot.slot_end_us;
    const ClaimedLoop& claim = *visit.claim;
    keys.emplace_back(claim.loop.loop_id, newest);
    for (const std::int64_t end : earlier_slots(newest, claim.last_slot_end_us, claim.loop.period_s,
                                                settings_->schedule.revise_slots)) {
      keys.emplace_back(claim.loop.loop_id, end);
    }
  }
  return StoredAnalyses(with_results([&](storage::ResultsDatabase& database) {
    return database.stored_digests(keys, core::kAlgorithmRevision, settings_json_);
  }));
}

void Worker::set_aside(const std::string& source, const Failure& failure, const Claims& claims,
                       Batch& batch) {
  faults_.fault("historian " + source, std::string(failure.what()) + " HINT: " + failure.hint());
  if (!first_failure_) first_failure_ = failure;
  constexpr std::chrono::duration<double> kPause = kSourcePause;
  for (const ClaimedLoop* claim : claims) {
    batch.failed.push_back({claim->loop.loop_id, claim->fence, failure.what(), kPause.count()});
  }
}

void Worker::analyse(Batch& batch) {
  for (const LoopVisit& visit : batch.visits) {
    const ClaimedLoop& claim = *visit.claim;
    try {
      batch.completed.push_back(complete_visit(visit, batch.stored, *settings_, settings_json_));
    } catch (const std::exception& error) {
      spdlog::error("loop \"{}\" could not be analysed: {}", claim.loop.name, error.what());
      if (!first_failure_) {
        first_failure_ =
            Failure(ExitCode::fault, "loop \"" + claim.loop.name + "\": " + error.what(),
                    "this is a fault in the program: please report it");
      }
      batch.failed.push_back(
          {claim.loop.loop_id, claim.fence, error.what(), retry_pause_s(claim.attempts)});
    }
  }
}

}  // namespace loopscope::daemon
