#include "daemon/backfill/past_slots.hpp"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnose.hpp"
#include "daemon/service/historians/source_gate.hpp"
#include "daemon/service/windows/slot.hpp"

namespace loopscope::daemon {
namespace {

using storage::ClaimedLoop;

/// A claim ends when its first loop falls due: small batches are done before.
constexpr std::size_t kLoopsAtOnce = 16;
/// A batch of that size with a model for each takes two seconds, and longer when others work.
constexpr double kReserve_s = 30.0;
/// A loop whose work fails so often in a row is given up; with the pauses between of a poll each, a
/// server has restarted meanwhile.
constexpr int kFailures = 6;
/// For a loop that cannot be claimed.
constexpr double kLongestWait_s = 3600.0;

std::chrono::steady_clock::duration seconds(double s) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(s));
}

}  // namespace

PastSlots::PastSlots(std::shared_ptr<const config::Settings> settings, SharedServices& tools,
                     std::vector<storage::CatalogueEntry> loops, std::vector<std::int64_t> times_us,
                     bool again)
    : settings_(std::move(settings)),
      tools_(tools),
      times_us_(std::move(times_us)),
      again_(again),
      results_(settings_, tools.faults, tools.metrics, tools.clocks, tools.stop, tools.watermarks) {
  for (storage::CatalogueEntry& loop : loops) {
    by_id_[loop.loop_id] = loops_.size();
    if (!times_us_.empty()) ready_.insert({0, loops_.size()});
    loops_.push_back({std::move(loop)});
  }
}

std::int64_t PastSlots::slot_of(const Place& place) const {
  return floor_to_period(times_us_[place.next], place.loop.period_s);
}

std::vector<ClaimedLoop> PastSlots::next(AnalysisWorker& worker) {
  std::unique_lock lock(mutex_);
  while (!tools_.stop.stop_requested()) {
    wake();
    if (ready_.empty()) {
      if (in_hand_ == 0 && waiting_.empty()) break;
      wait(lock);
      continue;
    }
    std::vector<PlaceNumber> places = take();
    if (!again_) leave_out_stored(places);
    if (places.empty()) continue;
    std::vector<ClaimedLoop> claims = claim(worker, places);
    if (!claims.empty()) return claims;
  }
  changed_.notify_all();
  return {};
}

void PastSlots::wake() {
  const Clock::time_point now = Clock::now();
  while (!waiting_.empty() && waiting_.begin()->first <= now) {
    const PlaceNumber number = waiting_.begin()->second;
    ready_.insert({loops_[number].next, number});
    waiting_.erase(waiting_.begin());
  }
}

void PastSlots::wait(std::unique_lock<std::mutex>& lock) {
  const auto may_go_on = [this] { return !ready_.empty() || (in_hand_ == 0 && waiting_.empty()); };
  const auto until = waiting_.empty() ? Clock::now() + seconds(settings_->schedule.poll_s)
                                      : waiting_.begin()->first;
  changed_.wait_until(lock, tools_.stop, until, may_go_on);
}

std::vector<PastSlots::PlaceNumber> PastSlots::take() {
  const auto most =
      std::min(kLoopsAtOnce, static_cast<std::size_t>(settings_->schedule.batch_loops));
  std::vector<PlaceNumber> places;
  while (places.size() < most && !ready_.empty()) {
    const PlaceNumber number = ready_.begin()->second;
    // Of a batch that failed each is tried alone: it shows then whose fault it was.
    const bool alone = loops_[number].failures > 0;
    if (alone && !places.empty()) break;
    places.push_back(number);
    ready_.erase(ready_.begin());
    if (alone) break;
  }
  return places;
}

void PastSlots::leave_out_stored(std::vector<PlaceNumber>& places) {
  std::vector<std::pair<std::int64_t, std::int64_t>> keys;
  for (const PlaceNumber number : places)
    keys.emplace_back(loops_[number].loop.loop_id, slot_of(loops_[number]));
  const auto ask = [&](storage::ResultsDatabase& database) {
    return database.stored_digests(keys, core::kAlgorithmRevision);
  };
  for (const storage::StoredDigest& row : results_.with_retry(tools_.perseverance, ask, [] {})) {
    const PlaceNumber number = by_id_.at(row.loop_id);
    std::erase(places, number);
    // Of a batch that failed in part the rows of the others are there already.
    if (!loops_[number].tried) ++stored_;
    advance(number);
  }
}

std::vector<ClaimedLoop> PastSlots::claim(AnalysisWorker& worker,
                                          const std::vector<PlaceNumber>& places) {
  std::vector<std::pair<std::int64_t, std::int64_t>> wishes;
  for (const PlaceNumber number : places)
    wishes.emplace_back(loops_[number].loop.loop_id, slot_of(loops_[number]));
  std::vector<ClaimedLoop> claims = worker.claim_past(kReserve_s, wishes);
  std::set<PlaceNumber> refused(places.begin(), places.end());
  for (const ClaimedLoop& claim : claims) refused.erase(by_id_.at(claim.loop.loop_id));
  wait_for(refused);
  in_hand_ += claims.size();
  return claims;
}

void PastSlots::wait_for(const std::set<PlaceNumber>& refused) {
  if (refused.empty()) return;
  std::vector<std::int64_t> ids;
  for (const PlaceNumber number : refused) ids.push_back(loops_[number].loop.loop_id);
  const auto ask = [&](storage::ResultsDatabase& database) { return database.enabled_of(ids); };
  const auto enabled = results_.with_retry(tools_.perseverance, ask, [] {});
  for (const PlaceNumber number : refused) {
    Place& place = loops_[number];
    // Whoever judges its newest slot lets go of it soon.
    const auto limit =
        seconds(std::min(2.0 * place.loop.period_s, kLongestWait_s) + settings_->schedule.lease_s);
    place.free_until = std::min(place.free_until, Clock::now() + limit);
    const bool away = !enabled.contains(place.loop.loop_id) || place.free_until < Clock::now();
    away ? give_up(number) : put_off(number, settings_->schedule.poll_s);
  }
}

void PastSlots::done(const std::vector<ClaimedLoop>& claims, const storage::WriteCount& count) {
  const std::lock_guard lock(mutex_);
  in_hand_ -= claims.size();
  const bool went_well = count.failed == 0 && count.fenced_off == 0;
  if (went_well) unrecorded_ += count.unchanged;
  for (const ClaimedLoop& claim : claims) {
    const PlaceNumber number = by_id_.at(claim.loop.loop_id);
    Place& place = loops_[number];
    place.tried = true;
    if (went_well) {
      advance(number);
    } else if (count.failed > 0 && ++place.failures >= kFailures) {
      give_up(number);
    } else {
      put_off(number, source_pause_s(settings_->schedule));
    }
  }
  changed_.notify_all();
}

void PastSlots::advance(PlaceNumber number) {
  Place& place = loops_[number];
  const std::int64_t slot_us = slot_of(place);
  place.failures = 0;
  place.tried = false;
  place.free_until = Clock::time_point::max();
  do {
    ++place.next;
    ++settled_;
  } while (place.next < times_us_.size() && slot_of(place) == slot_us);
  if (place.next < times_us_.size()) ready_.insert({place.next, number});
}

void PastSlots::put_off(PlaceNumber number, double pause_s) {
  waiting_.emplace(Clock::now() + seconds(pause_s), number);
}

void PastSlots::give_up(PlaceNumber number) {
  given_up_.push_back(loops_[number].loop.name);
}

std::size_t PastSlots::stored() const {
  const std::lock_guard lock(mutex_);
  return stored_;
}

std::size_t PastSlots::unrecorded() const {
  const std::lock_guard lock(mutex_);
  return unrecorded_;
}

std::vector<std::string> PastSlots::given_up() const {
  const std::lock_guard lock(mutex_);
  return given_up_;
}

}  // namespace loopscope::daemon
