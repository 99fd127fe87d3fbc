#include "daemon/service/worker.hpp"

#include <chrono>
#include <spdlog/spdlog.h>
#include <utility>

#include "config/read_settings.hpp"
#include "daemon/failure.hpp"
#include "daemon/service/analyse_window.hpp"
#include "daemon/service/storage_settings.hpp"

namespace loopscope::daemon {
namespace {

using storage::ClaimedLoop;
using Claims = std::vector<const ClaimedLoop*>;

/// The loops of a historian that is away are not at fault: their pause does not grow, so that they
/// go on soon after it is back.
constexpr double kSourcePause_s = 30.0;

std::map<std::string, Claims> by_source(const std::vector<ClaimedLoop>& claims) {
  std::map<std::string, Claims> groups;
  for (const ClaimedLoop& claim : claims) groups[claim.loop.source].push_back(&claim);
  return groups;
}

std::string digest_for(const std::vector<storage::StoredDigest>& stored, std::int64_t loop_id) {
  for (const storage::StoredDigest& row : stored) {
    if (row.loop_id == loop_id) return row.input_digest;
  }
  return {};
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace

Worker::Worker(std::shared_ptr<const config::Settings> settings, std::string owner,
               SlotRule slot_rule, FaultLog& faults)
    : settings_(std::move(settings)),
      settings_json_(config::analysis_settings_json(settings_->analysis)),
      owner_(std::move(owner)),
      slot_rule_(slot_rule),
      faults_(faults) {}

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

storage::HistorianReader& Worker::historian(const std::string& source) {
  const auto known = historians_.find(source);
  if (known != historians_.end()) return known->second;
  const config::HistorianSettings& settings = find_historian(*settings_, source);
  storage::HistorianReader reader(historian_connection(settings), historian_layout(settings));
  return historians_.emplace(source, std::move(reader)).first->second;
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

storage::WriteCount Worker::process(const std::vector<ClaimedLoop>& claims) {
  Batch batch;
  for (const auto& [source, loops] : by_source(claims)) fetch(source, loops, batch);
  analyse(batch);
  return with_results([&](storage::ResultsDatabase& database) {
    return database.finish(batch.completed, batch.failed);
  });
}

std::vector<LoopInput> Worker::read(const std::string& source, const Claims& claims) {
  const core::AnalysisSettings& analysis = settings_->analysis;
  const WindowSettings window_settings{analysis.prepare.window_samples,
                                       settings_->schedule.settle_s, slot_rule_,
                                       mode_codes(find_historian(*settings_, source))};
  const bool fresh = historians_.find(source) == historians_.end();
  try {
    return read_inputs(historian(source), claims, window_settings, analysis);
  } catch (const storage::DatabaseError& error) {
    historians_.erase(source);
    // A connection that died while it was idle says nothing about the server: one new one is tried.
    if (fresh || error.remedy() != storage::Remedy::reconnect) throw;
  }
  return read_inputs(historian(source), claims, window_settings, analysis);
}

void Worker::fetch(const std::string& source, const Claims& claims, Batch& batch) {
  const auto start = std::chrono::steady_clock::now();
  try {
    auto inputs = read(source, claims);
    double reading_ms = milliseconds_since(start);
    for (const LoopInput& input : inputs) reading_ms -= input.first_look_ms;
    const double fetch_ms = reading_ms / static_cast<double>(claims.size());
    for (std::size_t k = 0; k < claims.size(); ++k) {
      batch.fetched.push_back({claims[k], std::move(inputs[k]), fetch_ms});
    }
    faults_.recovered("historian " + source);
  } catch (const storage::DatabaseError& error) {
    historians_.erase(source);
    set_aside(source, {ExitCode::database, error.what(), error.hint()}, claims, batch);
  } catch (const Failure& failure) {
    set_aside(source, failure, claims, batch);
  }
}

void Worker::set_aside(const std::string& source, const Failure& failure, const Claims& claims,
                       Batch& batch) {
  faults_.fault("historian " + source, std::string(failure.what()) + " HINT: " + failure.hint());
  if (!first_failure_) first_failure_ = failure;
  for (const ClaimedLoop* claim : claims) {
    batch.failed.push_back({claim->loop.loop_id, claim->fence, failure.what(), kSourcePause_s});
  }
}

void Worker::analyse(Batch& batch) {
  std::vector<std::pair<std::int64_t, std::int64_t>> keys;
  for (const Fetched& fetched : batch.fetched) {
    keys.emplace_back(fetched.claim->loop.loop_id, fetched.input.at_slot.slot_end_us);
  }
  const auto stored = with_results([&](storage::ResultsDatabase& database) {
    return database.stored_digests(keys, core::kAlgorithmRevision);
  });
  for (const Fetched& fetched : batch.fetched) {
    analyse_loop(fetched, digest_for(stored, fetched.claim->loop.loop_id), batch);
  }
}

void Worker::analyse_loop(const Fetched& fetched, const std::string& stored_digest, Batch& batch) {
  const storage::CatalogueEntry& loop = fetched.claim->loop;
  const std::int64_t slot_end_us = fetched.input.at_slot.slot_end_us;
  storage::CompletedLoop completed{
      loop.loop_id, fetched.claim->fence, slot_end_us,
      next_due(slot_end_us, loop.period_s, settings_->schedule.settle_s), std::nullopt};
  try {
    if (digest_of(loop, fetched.input, settings_json_) != stored_digest) {
      completed.record = analyse_window(loop, fetched.input, settings_->analysis, settings_json_);
      completed.record->fetch_ms = fetched.fetch_ms;
    }
    batch.completed.push_back(std::move(completed));
  } catch (const std::exception& error) {
    spdlog::error("loop \"{}\" could not be analysed: {}", loop.name, error.what());
    if (!first_failure_) {
      first_failure_ = Failure(ExitCode::fault, "loop \"" + loop.name + "\": " + error.what(),
                               "this is a fault in the program: please report it");
    }
    batch.failed.push_back(
        {loop.loop_id, fetched.claim->fence, error.what(), retry_pause_s(fetched.claim->attempts)});
  }
}

}  // namespace loopscope::daemon
