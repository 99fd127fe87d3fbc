#include "storage/results/leases/held_loops.hpp"

#include "storage/array_literal.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

// Rows that are locked are being given back in this moment: to wait for them could end in a
// deadlock.
const Statement kExtend{"extend_leases", R"(
    UPDATE loopscope.schedule AS s SET
      visible_at = now() + $3::float8 * interval '1 second', hold_s = $3::float8
    WHERE s.ctid = ANY (ARRAY(
      SELECT free.ctid FROM loopscope.schedule AS free
      JOIN unnest($1::bigint[], $2::bigint[]) AS held (loop_id, fence)
        ON free.loop_id = held.loop_id AND free.fence = held.fence
      WHERE free.owner IS NOT NULL
      FOR UPDATE OF free SKIP LOCKED)))",
                        Rows::none};

const Statement kLostClaims{"lost_claims", R"(
    SELECT held.loop_id, held.fence FROM unnest($1::bigint[], $2::bigint[]) AS held (loop_id, fence)
    LEFT JOIN loopscope.schedule AS s ON s.loop_id = held.loop_id AND s.fence = held.fence
    WHERE s.loop_id IS NULL)"};

const Statement kRelease{"release", R"(
    UPDATE loopscope.schedule AS s SET owner = NULL, visible_at = now()
    FROM unnest($1::bigint[], $2::bigint[]) AS held (loop_id, fence)
    WHERE s.loop_id = held.loop_id AND s.fence = held.fence AND s.owner IS NOT NULL)",
                         Rows::none};

const Statement kReleaseOwned{"release_owned", R"(
    UPDATE loopscope.schedule SET owner = NULL, visible_at = now() WHERE owner = $1)",
                              Rows::none};

// What a clock ahead has put off. A loop without failures waits for its next slot, one with
// failures for the pause that its attempts give (daemon/service/windows/slot.hpp, retry_pause_s); a
// claim ends after the time for which it was made, and does so from now on: a worker that lives
// prolongs it before. Beyond the settling time nothing else adds to either. No loop that nobody
// holds waits for less than the shortest period, so that the scan of the due index begins there (a
// parameter, because the planner has to see how few these are); a slot that lies after the time of
// its loop has an index of its own (schedule_ahead).
const Statement kShortestPeriod{
    "shortest_period",
    "SELECT coalesce(min(period_s), 0)::float8 AS period_s FROM loopscope.loop WHERE enabled",
    Rows::one};

const Statement kFindStray{"find_stray", R"(
    WITH ahead AS (
      SELECT * FROM loopscope.schedule
      WHERE enabled AND visible_at > now() + ($1::float8 + $2::float8) * interval '1 second'
      UNION
      SELECT * FROM loopscope.schedule WHERE enabled AND owner IS NOT NULL AND visible_at > now()
      UNION
      SELECT * FROM loopscope.schedule
      WHERE enabled AND (last_slot_end > visible_at OR result_slot_end > visible_at)
    ), stray AS (
      SELECT s.loop_id, s.fence,
             CASE WHEN s.visible_at <= now() + bound.wait_s * interval '1 second' THEN s.visible_at
                  WHEN s.owner IS NULL THEN now()
                  ELSE now() + bound.wait_s * interval '1 second' END AS visible_at,
             s.last_slot_end > now() OR s.result_slot_end > now() AS has_future_slot
      FROM ahead AS s
      JOIN loopscope.loop USING (loop_id)
      CROSS JOIN LATERAL (SELECT CASE
        WHEN s.owner IS NOT NULL THEN coalesce(s.hold_s, 86400)
        WHEN s.last_error IS NULL THEN loop.period_s + $1::float8
        ELSE greatest(loop.period_s + $1::float8, least(60 * 2 ^ least(s.attempts, 9), 21600))
        END AS wait_s) AS bound
      WHERE s.visible_at > now() + bound.wait_s * interval '1 second'
        OR s.last_slot_end > now() OR s.result_slot_end > now()
    )
    SELECT stray.loop_id, stray.fence,
           (extract(epoch FROM stray.visible_at) * 1000000)::bigint AS visible_at_us,
           (SELECT (extract(epoch FROM max(verdict.slot_end)) * 1000000)::bigint
            FROM loopscope.verdict
            WHERE stray.has_future_slot AND verdict.loop_id = stray.loop_id
              AND verdict.slot_end <= now()) AS slot_end_us
    FROM stray)",
                           Rows::any, Kept::text};

// Apart from the look, so that a plan with few rows is made for few rows. Whoever holds one of them
// gives it back himself; to wait for him could end in a deadlock.
const Statement kRecall{"recall", R"(
    WITH known AS MATERIALIZED (
      SELECT found.* FROM loopscope.schedule AS free
      JOIN unnest($1::bigint[], $2::bigint[], $3::timestamptz[], $4::timestamptz[])
        AS found (loop_id, fence, visible_at, slot_end)
        ON free.loop_id = found.loop_id AND free.fence = found.fence
      FOR UPDATE OF free SKIP LOCKED)
    UPDATE loopscope.schedule AS s SET
      visible_at = known.visible_at,
      last_slot_end = CASE WHEN s.last_slot_end > now() THEN known.slot_end
                           ELSE s.last_slot_end END,
      result_slot_end = CASE WHEN s.result_slot_end > now() THEN known.slot_end
                             ELSE s.result_slot_end END
    FROM known WHERE s.loop_id = known.loop_id AND s.fence = known.fence
    RETURNING s.loop_id)"};

/// The two arrays that name claims.
std::vector<std::string> claim_keys(std::span<const ClaimedLoop> claimed) {
  ArrayLiteral loop_id, fence;
  for (const ClaimedLoop& claim : claimed) {
    loop_id.add_integer(claim.loop.loop_id);
    fence.add_integer(claim.fence);
  }
  return {loop_id.text(), fence.text()};
}

}  // namespace

std::vector<ClaimKey> extend(Transaction& transaction, std::span<const ClaimedLoop> claimed,
                             double lease_s) {
  const std::vector<std::string> keys = claim_keys(claimed);
  transaction.run(kExtend, {keys[0], keys[1], number_text(lease_s)});
  std::vector<ClaimKey> lost;
  for (const pqxx::row& row : transaction.run(kLostClaims, keys))
    lost.push_back({row["loop_id"].as<std::int64_t>(), row["fence"].as<std::int64_t>()});
  return lost;
}

void release(Transaction& transaction, std::span<const ClaimedLoop> claimed) {
  release(transaction, claim_keys(claimed));
}

void release(Transaction& transaction, const std::vector<std::string>& keys) {
  transaction.run(kRelease, keys);
}

void release_owned(Transaction& transaction, const std::string& owner) {
  transaction.run(kReleaseOwned, {make_storable(owner)});
}

std::size_t recall_stray(Transaction& transaction, double settle_s) {
  const auto period_s = transaction.run(kShortestPeriod)[0][0].as<double>();
  ArrayLiteral loop_id, fence, visible_at, slot_end;
  const pqxx::result strays =
      transaction.run(kFindStray, {number_text(settle_s), number_text(period_s)});
  if (strays.empty()) return 0;
  for (const pqxx::row& stray : strays) {
    loop_id.add_integer(stray["loop_id"].as<std::int64_t>());
    fence.add_integer(stray["fence"].as<std::int64_t>());
    visible_at.add_time(stray["visible_at_us"].as<std::int64_t>());
    const auto slot_end_us = read_integer(stray["slot_end_us"]);
    slot_end_us ? slot_end.add_time(*slot_end_us) : slot_end.add_null();
  }
  const std::vector<std::string> columns{loop_id.text(), fence.text(), visible_at.text(),
                                         slot_end.text()};
  return static_cast<std::size_t>(transaction.run(kRecall, columns).size());
}

}  // namespace loopscope::storage
