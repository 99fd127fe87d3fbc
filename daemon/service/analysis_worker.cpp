#include "daemon/service/analysis_worker.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <spdlog/spdlog.h>
#include <utility>

#include "config/read_settings.hpp"
#include "daemon/service/batches/batch.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/observe/stage_timings.hpp"
#include "daemon/service/observe/work_report.hpp"
#include "daemon/service/threads/worker_identity.hpp"
#include "daemon/text/failure.hpp"
#include "storage/batch_share.hpp"

namespace loopscope::daemon {
namespace {

using storage::ClaimedLoop;

constexpr std::chrono::minutes kCountEvery{5};
/// Somebody has to mend what refuses results; to analyse them again at every poll helps nobody.
constexpr double kRefusedPause_s = 60.0;

}  // namespace

AnalysisWorker::AnalysisWorker(std::shared_ptr<const config::Settings> settings, std::size_t index,
                               SlotRule slot_rule, SharedServices& tools)
    : settings_(std::move(settings)),
      settings_json_(config::analysis_settings_json(settings_->analysis)),
      index_(index),
      owner_(worker_name(index)),
      tools_(tools),
      progress_(tools.progress.entry()),
      driver_([this] { progress_.step(); }),
      results_(settings_, tools.faults, tools.metrics, tools.clocks, tools.stop, tools.watermarks),
      reader_(settings_, settings_json_, slot_rule, tools, progress_, results_, driver_) {}

template <typename Claim>
std::vector<ClaimedLoop> AnalysisWorker::timed_claim(Claim claim, bool again) {
  (void)driver_.take();  // what failed before has brought no loop to its end
  const auto ask = [&](storage::ResultsDatabase& database) {
    if (std::exchange(in_doubt_, true)) database.release_owned(owner_);
    std::vector<ClaimedLoop> claimed = claim(database);
    in_doubt_ = false;
    return claimed;
  };
  std::vector<ClaimedLoop> claims = driver_.run(
      &storage::StageCost::claim_s, [&] { return again ? with_retry(ask) : results_.with(ask); });
  const storage::StageCost cost = driver_.take();
  if (claims.empty()) return claims;  // what a look without a find takes is idling
  progress_.hold(claims);
  account(cost);
  return claims;
}

void AnalysisWorker::account(const storage::StageCost& cost) {
  costs_.add(cost);
  tools_.metrics.add(cost);
}

std::vector<ClaimedLoop> AnalysisWorker::claim_due() {
  if (tools_.comparing && index_ >= workers_beside_comparison(settings_->daemon)) return {};
  const config::ScheduleSettings& schedule = settings_->schedule;
  const std::vector<std::string> away = tools_.sources_away();
  return timed_claim([&](storage::ResultsDatabase& database) {
    return database.claim_due(owner_, schedule.hold_s(), schedule.batch_loops, away,
                              worker_count(settings_->daemon));
  });
}

std::vector<ClaimedLoop> AnalysisWorker::claim_suspect() {
  std::unique_lock turn(tools_.suspect_turn, std::try_to_lock);
  if (!turn) return {};
  std::vector<ClaimedLoop> claims = timed_claim([&](storage::ResultsDatabase& database) {
    return database.claim_suspect(owner_, settings_->schedule.hold_s());
  });
  if (!claims.empty()) suspect_turn_ = std::move(turn);
  return claims;
}

std::vector<ClaimedLoop> AnalysisWorker::claim_next(std::int64_t after, std::size_t left) {
  const config::ScheduleSettings& schedule = settings_->schedule;
  const int size =
      storage::batch_share(left, schedule.batch_loops, worker_count(settings_->daemon));
  return timed_claim([&](storage::ResultsDatabase& database) {
    return database.claim_next(owner_, schedule.hold_s(), size, after);
  });
}

std::vector<ClaimedLoop> AnalysisWorker::claim_past(
    double reserve_s, std::span<const std::pair<std::int64_t, std::int64_t>> loop_and_slot) {
  const auto claim = [&](storage::ResultsDatabase& database) {
    return database.claim_past(owner_, settings_->schedule.hold_s(), reserve_s, loop_and_slot);
  };
  return timed_claim(claim, true);
}

std::optional<double> AnalysisWorker::next_due_in_s() {
  return results_.with([this](storage::ResultsDatabase& database) {
    return database.next_due_in_s(settings_->schedule.poll_s);
  });
}

/// Loops grouped by historian, the one with the fewest users first. One that was down a moment ago
/// comes last: what it costs to find that it still is must not hold up the loops of others.
std::vector<std::pair<std::string, Claims>> AnalysisWorker::by_source(
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

storage::WriteCount AnalysisWorker::process(const std::vector<ClaimedLoop>& claims) {
  /// Whatever happens, nothing is held afterwards.
  struct Clear {
    AnalysisWorker& worker;
    ~Clear() {
      worker.progress_.drop();
      worker.suspect_turn_ = {};
    }
  } const clear{*this};
  Stopwatch watch;
  storage::WriteCount sum;
  try {
    for (const auto& [source, loops] : by_source(claims)) add(sum, process_source(source, loops));
  } catch (const std::exception& error) {
    give_back(error.what());
    throw;
  }
  tools_.metrics.count(sum);
  tools_.metrics.observe_batch(watch.lap_s());
  const WindowCache::Size kept = tools_.windows.size();
  tools_.metrics.kept_windows(kept.loops, kept.bytes);
  store_cost(costs_.take(false));
  return sum;
}

storage::WriteCount AnalysisWorker::process_source(const std::string& source,
                                                   const Claims& claims) {
  Batch batch{KeptWindows(tools_.windows, settings_, settings_json_)};
  const BatchReader::Read read = reader_.read(source, claims, batch);
  if (read == BatchReader::Read::apart) {
    storage::WriteCount sum;
    for (const ClaimedLoop* claim : claims) add(sum, process_source(source, {claim}));
    return sum;
  }
  const std::size_t lost = read == BatchReader::Read::all ? analyse(batch) : 0;
  storage::WriteCount count =
      driver_.run(&storage::StageCost::write_s, [&] { return write(claims, batch); });
  driver_.cost().loops = claims.size();
  account(driver_.take());
  if (!first_failure_) first_failure_ = batch.first_failure;
  count.fenced_off += lost;
  return count;
}

std::size_t AnalysisWorker::analyse(Batch& batch) {
  const AnalysisOrders orders{*settings_, settings_json_, enabled_loops()};
  const CoreGate::Permit core =
      driver_.run(&storage::StageCost::wait_s, [&] { return take_core(tools_.cores, progress_); });
  std::size_t lost = 0;
  for (LoopTask& task : batch.tasks) {
    if (progress_.lost(task.claim->loop.loop_id)) {
      ++lost;
    } else {
      complete(task, orders, batch);
    }
    task = {};  // its windows take some hundred kilobytes
  }
  batch.tasks.clear();
  batch.rows = {};
  return lost;
}

void AnalysisWorker::complete(LoopTask& task, const AnalysisOrders& orders, Batch& batch) {
  try {
    batch.completed.push_back(driver_.run(&storage::StageCost::decide_s, [&] {
      return complete_task(task, batch.stored, orders, driver_);
    }));
    batch.kept.keep(task, batch.completed.back(), batch.stored, batch.rows);
    keep_error(task, tools_.errors);
  } catch (const std::exception& error) {
    set_aside(*task.claim, as_failure(*task.claim, error), batch);
  }
}

storage::WriteCount AnalysisWorker::write(const Claims& claims, Batch& batch) {
  try {
    return finish(batch.completed, batch.failed);
  } catch (const storage::DatabaseError& error) {
    if (!is_row_error(error)) throw;
    return write_one_by_one(claims, batch);
  }
}

/// One loop's row is refused, and with it the whole transaction: the others do without it.
storage::WriteCount AnalysisWorker::write_one_by_one(const Claims& claims, Batch& batch) {
  storage::WriteCount sum;
  for (const storage::CompletedLoop& loop : std::exchange(batch.completed, {})) {
    try {
      add(sum, finish({loop}, {}));
    } catch (const storage::DatabaseError& error) {
      if (!is_row_error(error)) throw;
      const auto claim = std::ranges::find(
          claims, loop.loop_id, [](const ClaimedLoop* held) { return held->loop.loop_id; });
      set_aside(**claim, as_failure(error), batch);
    }
  }
  add(sum, finish({}, batch.failed));
  return sum;
}

storage::WriteCount AnalysisWorker::finish(const std::vector<storage::CompletedLoop>& completed,
                                           const std::vector<storage::FailedLoop>& failed) {
  const storage::WriteCount count = with_retry(
      [&](storage::ResultsDatabase& database) { return database.finish(completed, failed); });
  std::vector<std::int64_t> given_back;
  given_back.reserve(completed.size() + failed.size());
  for (const storage::CompletedLoop& loop : completed) given_back.push_back(loop.loop_id);
  for (const storage::FailedLoop& loop : failed) given_back.push_back(loop.loop_id);
  progress_.done(given_back);
  return count;
}

/// What could not be brought to its end goes back without blame, so that no lease is lost for a
/// fault that is not the loops': at once when the process stops, else after a pause. Where that
/// fails too they go back before the next claim, or the claims run out.
void AnalysisWorker::give_back(const std::string& reason) {
  const std::vector<ClaimedLoop> held = progress_.held();
  if (held.empty()) return;
  std::vector<storage::FailedLoop> failed;
  failed.reserve(held.size());
  for (const ClaimedLoop& claim : held) {
    failed.push_back(
        {claim.loop.loop_id, claim.fence, reason, kRefusedPause_s, false, claim.kept_due_us()});
  }
  try {
    results_.with([&](storage::ResultsDatabase& database) {
      const bool untouched = tools_.stop.stop_requested() && !held.front().past;
      untouched ? database.release(held) : void(database.finish({}, failed));
      return true;
    });
  } catch (const storage::DatabaseError& error) {
    in_doubt_ = true;
    results_.say(error);
  }
}

/// Counted anew now and then: the catalogue changes slowly.
std::size_t AnalysisWorker::enabled_loops() {
  const Clock::time_point now = Clock::now();
  if (!counted_at_ || now - *counted_at_ > kCountEvery) {
    enabled_loops_ = with_retry(
        [](storage::ResultsDatabase& database) { return database.count_enabled_loops(); });
    counted_at_ = now;
  }
  return enabled_loops_;
}

void AnalysisWorker::store_cost() {
  store_cost(costs_.take(true));
}

/// The record of costs is worth less than the work: without it, that goes on.
void AnalysisWorker::store_cost(const std::optional<storage::StageCost>& cost) {
  if (!cost) return;
  try {
    results_.with([&](storage::ResultsDatabase& database) {
      database.add_stage_cost({host_name(), static_cast<int>(index_)}, *cost);
      return true;
    });
    tools_.faults.recovered("record of costs", this);
  } catch (const storage::DatabaseError& error) {
    costs_.put_back(*cost);
    tools_.faults.fault("record of costs", std::string(error.what()) + " HINT: " + error.hint(),
                        this);
  }
}

}  // namespace loopscope::daemon
