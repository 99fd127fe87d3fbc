#include "daemon/service/worker.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <spdlog/spdlog.h>
#include <utility>

#include "config/read_settings.hpp"
#include "daemon/failure.hpp"
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

/// Loops grouped by historian, the one with the fewest users first. One that was down a moment ago
/// comes last: what it costs to find that it still is must not hold up the loops of others.
std::vector<std::pair<std::string, Worker::Claims>> Worker::by_source(
    const std::vector<ClaimedLoop>& claims) {
  std::map<std::string, Claims> groups;
  for (const ClaimedLoop& claim : claims) groups[claim.loop.source].push_back(&claim);
  std::multimap<std::pair<bool, int>, std::string> by_burden;
  for (const auto& [source, group] : groups) {
    by_burden.insert({{historians_.is_down(source), historians_.in_use(source)}, source});
  }
  std::vector<std::pair<std::string, Claims>> ordered;
  for (const auto& [burden, source] : by_burden) {
    ordered.emplace_back(source, std::move(groups[source]));
  }
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
    return visit_newest(historian, claims, *settings_, slot_rule_, batch.rows);
  });
}

/// Rows that came late for a slot that is stored change its window: a few earlier slots of each
/// loop are looked at again with every visit.
bool Worker::read_earlier(const std::string& source, const Claims& claims, Batch& batch) {
  const int horizon = settings_->schedule.revise_slots;
  const EarlierSlots earlier = earlier_slots_to_check(batch.visits, batch.stored, horizon);
  if (earlier.slots.empty()) return true;
  return with_source(source, claims, batch, [&](storage::HistorianReader& historian) {
    visit_earlier(historian, earlier, *settings_, batch.rows, batch.visits);
    return std::move(batch.visits);
  });
}

StoredAnalyses Worker::stored_analyses(const std::vector<LoopVisit>& visits) {
  const auto keys = slots_that_may_be_stored(visits, settings_->schedule.revise_slots);
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
