#include "tests/storage/results/lease_world.hpp"

#include <algorithm>
#include <iterator>
#include <rapidcheck.h>
#include <set>

#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

/// No lease ends and no pause passes by itself during a test.
constexpr double kLease_s = 100'000.0;
constexpr std::int64_t kNever_us = 4'102'444'800'000'000;  // 2100-01-01

}  // namespace

LeaseWorld::LeaseWorld(const tests::TestDatabase& database) : database_(database) {
  for (std::size_t k = 0; k < kLeaseWorkers; ++k)
    workers_.push_back(
        {"worker" + std::to_string(k), ResultsDatabase(settings_for(database)), {}, {}, {}});
}

void LeaseWorld::begin() {
  database_.execute(
      // Few rows in many partitions: TRUNCATE would make every one of them anew.
      "DELETE FROM loopscope.analysis; DELETE FROM loopscope.verdict;"
      " DELETE FROM loopscope.bicoherence_peak; DELETE FROM loopscope.explanation_step;"
      // A fence that stands is never turned back.
      " DELETE FROM loopscope.schedule;"
      " INSERT INTO loopscope.schedule (loop_id, enabled, visible_at)"
      " SELECT loop_id, enabled, now() - interval '1 s' FROM loopscope.loop");
  loops_.clear();
  for (const auto& row : database_.rows("SELECT loop_id FROM loopscope.schedule"))
    loops_[std::stoll(row.at(0))] = {};
  for (LeaseWorker& worker : workers_) {
    worker.believes.clear();
    worker.last_completed.clear();
    worker.last_failed.clear();
  }
  number_ = 0;
  written_ = false;
}

void LeaseWorld::take(const Step& step) {
  LeaseWorker& worker = workers_.at(step.worker);
  switch (step.deed) {
    case Deed::claim:
      return claim(worker);
    case Deed::claim_next:
      return claim_next(worker, step.which);
    case Deed::claim_suspect:
      return claim_suspect(worker);
    case Deed::complete:
    case Deed::complete_without_row:
      return complete(worker, step.which, step.deed == Deed::complete);
    case Deed::fail:
      return fail(worker, step.which);
    case Deed::release:
      return release(worker, step.which);
    case Deed::extend:
      return extend(worker);
    case Deed::repeat:
      return finish(worker);
    case Deed::stall:
    case Deed::be_due:
      return end_wait(step.which, step.deed == Deed::stall);
  }
}

void LeaseWorld::check() {
  RC_ASSERT(
      database_.rows("SELECT loop_id, fence, owner, visible_at <= now(), attempts, lost_leases,"
                     " (extract(epoch FROM last_slot_end) * 1000000)::bigint"
                     " FROM loopscope.schedule ORDER BY 1") == schedule_rows(loops_));
  check_holders();
  if (written_) check_analyses();
  written_ = false;
}

void LeaseWorld::check_analyses() {
  RC_ASSERT(database_.rows(
                "SELECT a.loop_id, (extract(epoch FROM slot_end) * 1000000)::bigint, input_digest,"
                " input_revision, (SELECT count(*) FROM loopscope.verdict AS v"
                "   WHERE v.loop_id = a.loop_id AND v.slot_end = a.slot_end), a.fence <= s.fence"
                " FROM loopscope.analysis AS a JOIN loopscope.schedule AS s USING (loop_id)"
                " ORDER BY 1, 2") == analysis_rows(loops_));
}

void LeaseWorld::check_holders() {
  for (const auto& [loop_id, loop] : loops_) {
    int holders = 0;
    for (const LeaseWorker& worker : workers_)
      for (const ClaimedLoop& claim : worker.believes)
        holders += claim.loop.loop_id == loop_id && claim.fence == loop.fence ? 1 : 0;
    RC_ASSERT(holders <= 1);
  }
}

void LeaseWorld::take_claims(LeaseWorker& worker, const std::vector<ClaimedLoop>& claimed,
                             const std::vector<std::int64_t>& expected) {
  std::vector<std::int64_t> ids;
  for (const ClaimedLoop& claim : claimed) {
    LeaseModel& loop = loops_.at(claim.loop.loop_id);
    RC_ASSERT(!loop.is_held());
    loop.claim(worker.name);
    RC_ASSERT(claim.fence == loop.fence);
    RC_ASSERT(claim.attempts == loop.attempts);
    RC_ASSERT(claim.last_slot_end_us == loop.last_slot_us);
    worker.believes.push_back(claim);
    ids.push_back(claim.loop.loop_id);
  }
  RC_ASSERT(ids == expected);
}

void LeaseWorld::claim(LeaseWorker& worker) {
  std::vector<std::int64_t> due;
  for (const auto& [loop_id, loop] : loops_)
    if (loop.visible && !loop.is_suspect()) due.push_back(loop_id);
  // What was due before the last claim comes with the next one.
  std::vector<ClaimedLoop> claimed;
  for (std::size_t before = due.size() + 1; claimed.size() != before;) {
    before = claimed.size();
    std::ranges::move(worker.results.claim_due(worker.name, kLease_s, 100),
                      std::back_inserter(claimed));
  }
  std::ranges::sort(claimed, {}, [](const ClaimedLoop& claim) { return claim.loop.loop_id; });
  take_claims(worker, claimed, due);
}

void LeaseWorld::claim_next(LeaseWorker& worker, std::size_t which) {
  const std::int64_t after = id_of(which);
  std::vector<std::int64_t> next;
  for (const auto& [loop_id, loop] : loops_)
    if (next.empty() && loop_id > after && (loop.owner.empty() || loop.visible) &&
        !loop.is_suspect())
      next.push_back(loop_id);
  take_claims(worker, worker.results.claim_next(worker.name, kLease_s, 1, after), next);
}

void LeaseWorld::claim_suspect(LeaseWorker& worker) {
  const auto claimed = worker.results.claim_suspect(worker.name, kLease_s);
  RC_ASSERT(claimed.size() <= 1U);
  bool is_there = false;
  for (auto& [loop_id, loop] : loops_) {
    const bool was_alone = loop.visible && !loop.owner.empty() && loop.lost_leases >= 3;
    if (was_alone) loop.rest();
    is_there = is_there || (loop.visible && loop.is_suspect());
  }
  RC_ASSERT(claimed.empty() != is_there);
  if (claimed.empty()) return;
  const std::int64_t loop_id = claimed.front().loop.loop_id;
  RC_ASSERT(loops_.at(loop_id).visible);
  RC_ASSERT(loops_.at(loop_id).is_suspect());
  take_claims(worker, claimed, {loop_id});
}

void LeaseWorld::complete(LeaseWorker& worker, std::size_t which, bool with_row) {
  if (worker.believes.empty()) return;
  const ClaimedLoop claim = drop(worker, which);
  // The newest slot or the one before it, as late rows bring about; a digest of few.
  const int hour = 1 + static_cast<int>(which % 3);
  CompletedLoop done = completed(claim, slot(hour), "digest" + std::to_string(number_++ % 2));
  done.next_due_us = kNever_us;
  if (!with_row) done.record.reset();
  worker.last_completed = {done};
  worker.last_failed.clear();
  finish(worker);
}

void LeaseWorld::fail(LeaseWorker& worker, std::size_t which) {
  if (worker.believes.empty()) return;
  const ClaimedLoop claim = drop(worker, which);
  worker.last_completed.clear();
  worker.last_failed = {{claim.loop.loop_id, claim.fence, "no rows", kLease_s}};
  finish(worker);
}

void LeaseWorld::finish(LeaseWorker& worker) {
  written_ = true;
  if (worker.last_completed.empty() && worker.last_failed.empty()) return;
  const WriteCount count = worker.results.finish(worker.last_completed, worker.last_failed);
  WriteCount expected;
  for (const CompletedLoop& done : worker.last_completed)
    loops_.at(done.loop_id).complete(done, expected);
  for (const FailedLoop& failed : worker.last_failed)
    loops_.at(failed.loop_id).fail(failed.fence, expected);
  RC_ASSERT(count.inserted == expected.inserted);
  RC_ASSERT(count.revised == expected.revised);
  RC_ASSERT(count.unchanged == expected.unchanged);
  RC_ASSERT(count.failed == expected.failed);
  RC_ASSERT(count.fenced_off == expected.fenced_off);
}

void LeaseWorld::release(LeaseWorker& worker, std::size_t which) {
  if (worker.believes.empty()) return;
  const ClaimedLoop claim = drop(worker, which);
  worker.results.release(std::vector{claim});
  loops_.at(claim.loop.loop_id).release(claim.fence);
}

void LeaseWorld::extend(LeaseWorker& worker) {
  std::vector<ClaimKey> lost;
  for (const ClaimedLoop& claim : worker.believes) {
    LeaseModel& loop = loops_.at(claim.loop.loop_id);
    if (loop.fence != claim.fence) {
      lost.push_back({claim.loop.loop_id, claim.fence});
    } else if (!loop.owner.empty()) {
      loop.visible = false;
    }
  }
  const auto said = worker.results.extend(worker.believes, kLease_s);
  RC_ASSERT(std::multiset(said.begin(), said.end()) == std::multiset(lost.begin(), lost.end()));
}

void LeaseWorld::end_wait(std::size_t which, bool is_lease) {
  const std::int64_t loop_id = id_of(which);
  LeaseModel& loop = loops_.at(loop_id);
  if (loop.owner.empty() == is_lease) return;
  database_.execute(
      "UPDATE loopscope.schedule SET visible_at = now() - interval '1 second'"
      " WHERE loop_id = " +
      std::to_string(loop_id));
  loop.visible = true;
}

std::int64_t LeaseWorld::id_of(std::size_t which) const {
  return std::next(loops_.begin(), static_cast<std::ptrdiff_t>(which % loops_.size()))->first;
}

ClaimedLoop LeaseWorld::drop(LeaseWorker& worker, std::size_t which) {
  const auto place =
      worker.believes.begin() + static_cast<std::ptrdiff_t>(which % worker.believes.size());
  const ClaimedLoop claim = *place;
  worker.believes.erase(place);
  return claim;
}

}  // namespace loopscope::storage
