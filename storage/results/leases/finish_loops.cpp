#include "storage/results/leases/finish_loops.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "storage/array_literal.hpp"
#include "storage/results/leases/claim_past.hpp"
#include "storage/results/leases/held_loops.hpp"
#include "storage/results/writes/write_problems.hpp"
#include "storage/results/writes/write_results.hpp"

namespace loopscope::storage {
namespace {

// The owner is not asked for: a repeat after a commit in doubt finds it gone and must still count
// as this worker's, which the fence proves. A slot after now() was noted under a clock ahead: what
// is done now is newer in truth; one that is done under such a clock has not come yet.
const Statement kComplete{"complete", R"(
    UPDATE loopscope.schedule AS s SET
      owner = NULL, visible_at = done.next_due, attempts = 0, lost_leases = 0,
      last_error = NULL,
      last_slot_end = CASE WHEN s.last_slot_end > now() THEN done.slot_end
                           ELSE greatest(s.last_slot_end, done.slot_end) END,
      result_slot_end = CASE WHEN s.result_slot_end > now() THEN done.slot_end
                             WHEN done.has_record THEN greatest(s.result_slot_end, done.slot_end)
                             ELSE s.result_slot_end END,
      pv_flat_s = CASE WHEN done.has_record THEN done.pv_flat_s ELSE s.pv_flat_s END,
      pv_step = CASE WHEN done.has_record THEN done.pv_step ELSE s.pv_step END
    FROM unnest($1::bigint[], $2::bigint[], $3::timestamptz[], $4::timestamptz[], $5::boolean[],
                $6::float8[], $7::float8[])
      AS done (loop_id, fence, slot_end, next_due, has_record, pv_flat_s, pv_step)
    WHERE s.loop_id = done.loop_id AND s.fence = done.fence AND done.slot_end <= now()
    RETURNING s.loop_id)",
                          Rows::any, Kept::text};

// A repeat finds no owner and counts no second failure. The worker lived to tell: no lease is lost.
const Statement kSetAside{"set_aside", R"(
    UPDATE loopscope.schedule AS s SET
      owner = NULL, visible_at = now() + failed.retry_after_s * interval '1 second',
      attempts = least(s.attempts + (s.owner IS NOT NULL AND failed.at_fault)::integer, 1000000),
      lost_leases = 0,
      last_error = failed.error
    FROM unnest($1::bigint[], $2::bigint[], $3::text[], $4::float8[], $5::boolean[])
      AS failed (loop_id, fence, error, retry_after_s, at_fault)
    WHERE s.loop_id = failed.loop_id AND s.fence = failed.fence
    RETURNING s.loop_id)"};

/// Those whose lease holds but whose slot has not come are due again at once.
void release_others(Transaction& transaction, std::span<const CompletedLoop> completed,
                    const std::unordered_set<std::int64_t>& held) {
  ArrayLiteral loop_id, fence;
  for (const CompletedLoop& loop : completed) {
    if (held.contains(loop.loop_id)) continue;
    loop_id.add_integer(loop.loop_id);
    fence.add_integer(loop.fence);
  }
  release(transaction, {loop_id.text(), fence.text()});
}

/// Gives the completed loops back and returns those whose lease still held and whose slot has come.
std::vector<const CompletedLoop*> complete(Transaction& transaction,
                                           std::span<const CompletedLoop> completed) {
  ArrayLiteral loop_id, fence, slot_end, next_due, has_record, pv_flat_s, pv_step;
  for (const CompletedLoop& loop : completed) {
    loop_id.add_integer(loop.loop_id);
    fence.add_integer(loop.fence);
    slot_end.add_time(loop.slot_end_us);
    next_due.add_time(loop.next_due_us);
    has_record.add_boolean(loop.record.has_value());
    const auto past =
        loop.record ? loop.record->diagnosis.evidence.pv_past : core::signal::PvPast{};
    pv_flat_s.add_number(past.longest_flat_s);
    past.step > 0.0 ? pv_step.add_number(past.step) : pv_step.add_null();
  }
  std::unordered_set<std::int64_t> held;
  for (const pqxx::row& row :
       transaction.run(kComplete, {loop_id.text(), fence.text(), slot_end.text(), next_due.text(),
                                   has_record.text(), pv_flat_s.text(), pv_step.text()})) {
    held.insert(row["loop_id"].as<std::int64_t>());
  }
  if (held.size() < completed.size()) release_others(transaction, completed, held);
  std::vector<const CompletedLoop*> kept;
  for (const CompletedLoop& loop : completed) {
    if (held.contains(loop.loop_id)) kept.push_back(&loop);
  }
  return kept;
}

/// Gives back what was claimed for past slots, done or failed, and returns whose claim still held.
template <typename Loops>
std::unordered_set<std::int64_t> give_back(Transaction& transaction, const Loops& loops) {
  ArrayLiteral loop_id, fence, due;
  for (const auto& loop : loops) {
    loop_id.add_integer(loop.loop_id);
    fence.add_integer(loop.fence);
    due.add_time(*loop.kept_due_us);
  }
  const auto held = give_back_past(transaction, {loop_id.text(), fence.text(), due.text()});
  return {held.begin(), held.end()};
}

/// As complete() of claims for past slots.
std::vector<const CompletedLoop*> complete_past(Transaction& transaction,
                                                std::span<const CompletedLoop> completed) {
  const std::unordered_set<std::int64_t> held = give_back(transaction, completed);
  std::vector<const CompletedLoop*> kept;
  for (const CompletedLoop& loop : completed) {
    if (held.contains(loop.loop_id)) kept.push_back(&loop);
  }
  return kept;
}

/// Returns how many leases still held.
std::size_t set_aside(Transaction& transaction, std::span<const FailedLoop> failed) {
  if (failed.empty()) return 0;
  if (failed.front().kept_due_us) return give_back(transaction, failed).size();
  ArrayLiteral loop_id, fence, error, retry_after_s, at_fault;
  for (const FailedLoop& loop : failed) {
    loop_id.add_integer(loop.loop_id);
    fence.add_integer(loop.fence);
    error.add_text(loop.error);
    retry_after_s.add_number(loop.retry_after_s);
    at_fault.add_boolean(loop.at_fault);
  }
  return transaction
      .run(kSetAside,
           {loop_id.text(), fence.text(), error.text(), retry_after_s.text(), at_fault.text()})
      .size();
}

/// The revised analyses of earlier slots, each as a completed loop of its own.
std::vector<CompletedLoop> earlier_records(const std::vector<const CompletedLoop*>& held) {
  std::vector<CompletedLoop> earlier;
  for (const CompletedLoop* loop : held) {
    for (const AnalysisRecord& record : loop->revised) {
      CompletedLoop& slot = earlier.emplace_back();
      slot.loop_id = loop->loop_id;
      slot.fence = loop->fence;
      slot.slot_end_us = record.slot_end_us;
      slot.record = record;
    }
  }
  return earlier;
}

std::size_t revise_earlier(Transaction& transaction,
                           const std::vector<const CompletedLoop*>& held) {
  const std::vector<CompletedLoop> earlier = earlier_records(held);
  std::vector<const CompletedLoop*> pointers;
  pointers.reserve(earlier.size());
  for (const CompletedLoop& slot : earlier) pointers.push_back(&slot);
  const WriteCount count = write_records(transaction, pointers);
  return count.revised + count.inserted;
}

WriteCount write_completed(Transaction& transaction,
                           const std::vector<const CompletedLoop*>& held) {
  std::vector<const CompletedLoop*> with_record = held;
  std::erase_if(with_record, [](const CompletedLoop* loop) { return !loop->record; });
  WriteCount count = write_records(transaction, with_record);
  count.unchanged += held.size() - with_record.size();
  count.revised_earlier = revise_earlier(transaction, held);
  count.not_judged = static_cast<std::size_t>(
      std::ranges::count_if(held, [](const CompletedLoop* loop) { return !loop->judged; }));
  write_problems(transaction, held);
  return count;
}

}  // namespace

WriteCount finish_loops(Transaction& transaction, std::span<const CompletedLoop> completed,
                        std::span<const FailedLoop> failed) {
  std::vector<const CompletedLoop*> held;
  if (!completed.empty())
    held = completed.front().kept_due_us ? complete_past(transaction, completed)
                                         : complete(transaction, completed);
  WriteCount count = write_completed(transaction, held);
  count.failed = set_aside(transaction, failed);
  count.fenced_off = completed.size() - held.size() + failed.size() - count.failed;
  return count;
}

}  // namespace loopscope::storage
