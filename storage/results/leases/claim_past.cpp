#include "storage/results/leases/claim_past.hpp"

#include <map>
#include <optional>

#include "core/diagnosis/diagnose.hpp"
#include "storage/array_literal.hpp"
#include "storage/results/leases/claim_statement.hpp"
#include "storage/results/session/results_clock.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

// Such a claim ends when the loop falls due: the workers that do the newest slots take it over
// then, in time. Where nobody does those, what is due or was lost with its worker is claimed too.
const Statement kClaimPast{
    "claim_past",
    LOOPSCOPE_CLAIM_UNTIL(
        "CASE WHEN s.visible_at > now()"
        " THEN least(s.visible_at, now() + $2::float8 * interval '1 second')"
        " ELSE now() + $2::float8 * interval '1 second' END",
        "FROM unnest($3::bigint[]) AS wanted (loop_id)"
        " JOIN loopscope.loop ON loop.loop_id = wanted.loop_id"
        " CROSS JOIN (SELECT EXISTS (SELECT FROM loopscope.worker"
        "   WHERE left_at IS NULL AND last_seen > now() - $2::float8 * interval '1 second')) AS "
        "others "
        "(work)" LOOPSCOPE_NEWEST_SCHEDULE(
            "wanted.loop_id") "WHERE due.enabled AND NOT (" LOOPSCOPE_SUSPECT
                              ") AND CASE WHEN others.work"
                              "  THEN due.owner IS NULL AND due.visible_at > now()"
                              "       + least($4::float8, loop.period_s / 2) * interval '1 second'"
                              "  ELSE due.owner IS NULL OR due.visible_at <= now() END")};

// What a worker that judged the slots in their order would know by then.
const Statement kStateBefore{"state_before_slot", R"(
    SELECT wanted.loop_id, known.pv_flat_s, known.pv_step, said.code AS last_code,
           said.confidence AS last_confidence, said.p AS last_p
    FROM unnest($1::bigint[], $2::timestamptz[]) AS wanted (loop_id, slot_end)
    CROSS JOIN LATERAL (
      SELECT stored.* FROM loopscope.analysis AS stored
      WHERE stored.loop_id = wanted.loop_id AND stored.slot_end < wanted.slot_end
        AND stored.algorithm_revision = $3::integer
      ORDER BY stored.slot_end DESC LIMIT 1) AS known
    LEFT JOIN LATERAL (
      SELECT verdict.code, verdict.confidence, verdict.p FROM loopscope.verdict
      WHERE verdict.loop_id = known.loop_id AND verdict.slot_end = known.slot_end
        AND verdict.algorithm_revision = known.algorithm_revision
        AND verdict.input_revision = known.input_revision LIMIT 1) AS said ON true)"};

const Statement kGiveBackPast{"give_back_past", R"(
    UPDATE loopscope.schedule AS s SET owner = NULL, visible_at = held.due
    FROM unnest($1::bigint[], $2::bigint[], $3::timestamptz[]) AS held (loop_id, fence, due)
    WHERE s.loop_id = held.loop_id AND s.fence = held.fence
    RETURNING s.loop_id)"};

std::vector<ClaimedLoop> claim_loops(Transaction& transaction, const PastClaim& claim,
                                     const std::map<std::int64_t, std::int64_t>& slots) {
  ArrayLiteral loop_id;
  for (const auto& [loop, slot_end_us] : slots) loop_id.add_integer(loop);
  std::vector<ClaimedLoop> claimed;
  for (const pqxx::row& row :
       transaction.run(kClaimPast, {make_storable(claim.owner), number_text(claim.lease_s),
                                    loop_id.text(), number_text(claim.reserve_s)})) {
    ClaimedLoop& loop = claimed.emplace_back(read_claim(row));
    loop.past = PastSlot{slots.at(loop.loop.loop_id), row["due_us"].as<std::int64_t>()};
    loop.last_verdict = std::nullopt;
    loop.pv_past = std::nullopt;
    loop.last_slot_end_us = std::nullopt;
  }
  return claimed;
}

void add_state_before(Transaction& transaction, std::vector<ClaimedLoop>& claimed) {
  ArrayLiteral loop_id, slot_end;
  std::map<std::int64_t, ClaimedLoop*> by_id;
  for (ClaimedLoop& loop : claimed) {
    loop_id.add_integer(loop.loop.loop_id);
    slot_end.add_time(loop.past->end_us);
    by_id[loop.loop.loop_id] = &loop;
  }
  for (const pqxx::row& row : transaction.run(
           kStateBefore,
           {loop_id.text(), slot_end.text(), std::to_string(core::kAlgorithmRevision)})) {
    ClaimedLoop& loop = *by_id.at(row["loop_id"].as<std::int64_t>());
    loop.last_verdict = read_last_verdict(row);
    loop.pv_past = read_pv_past(row);
  }
}

}  // namespace

std::vector<ClaimedLoop> claim_past(Session& session, const ClockCheck& check,
                                    const PastClaim& claim) {
  const std::map<std::int64_t, std::int64_t> slots(claim.loop_and_slot.begin(),
                                                   claim.loop_and_slot.end());
  return transact_in_time(session, check, [&](Transaction& transaction) {
    std::vector<ClaimedLoop> claimed = claim_loops(transaction, claim, slots);
    if (!claimed.empty()) add_state_before(transaction, claimed);
    return claimed;
  });
}

std::vector<std::int64_t> give_back_past(Transaction& transaction,
                                         const std::vector<std::string>& keys) {
  std::vector<std::int64_t> held;
  for (const pqxx::row& row : transaction.run(kGiveBackPast, keys))
    held.push_back(row["loop_id"].as<std::int64_t>());
  return held;
}

}  // namespace loopscope::storage
