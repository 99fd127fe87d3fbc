#include "storage/results/rows/schedule_statements.hpp"

#include "storage/results/rows/loop_columns.hpp"

namespace loopscope::storage::statements {
namespace {

// A claim is ONE statement. The chosen rows are locked first and then updated by their place in the
// table (ctid): joined as a subquery they cost a scan of the whole table under an unlucky plan, and
// by key a look at every version that an old snapshot keeps. A claim that finds an owner takes over
// from a worker that was lost: that counts as a failure and as a lost lease, so that a loop which
// kills its workers is noticed. Only the database's clock is used.
#define LOOPSCOPE_CLAIM(CHOICE)                                                                 \
  "WITH chosen AS MATERIALIZED (SELECT due.ctid AS place, due.loop_id, due.visible_at " CHOICE  \
  " FOR UPDATE OF due SKIP LOCKED), claimed AS ("                                               \
  "  UPDATE loopscope.schedule AS s SET"                                                        \
  "    owner = $1, fence = s.fence + 1, visible_at = now() + $2::float8 * interval '1 second'," \
  "    hold_s = $2::float8,"                                                                    \
  "    attempts = least(s.attempts + (s.owner IS NOT NULL)::integer, 1000000),"                 \
  "    lost_leases = least(s.lost_leases + (s.owner IS NOT NULL)::integer, 1000000),"           \
  "    last_error = CASE WHEN s.owner IS NULL THEN s.last_error"                                \
  "                      ELSE 'the lease of ' || s.owner || ' ended without a result' END"      \
  "  WHERE s.ctid = ANY (ARRAY(SELECT chosen.place FROM chosen))"                               \
  "  RETURNING s.loop_id, s.fence, s.attempts, s.last_slot_end, s.result_slot_end,"             \
  "    s.pv_flat_s, s.pv_step) "                                                                \
  "SELECT " LOOPSCOPE_LOOP_COLUMNS                                                              \
  ","                                                                                           \
  "  claimed.fence, claimed.attempts, (extract(epoch FROM now()) * 1000000)::bigint AS now_us," \
  "  (extract(epoch FROM least(chosen.visible_at, now())) * 1000000)::bigint AS due_us,"        \
  "  (extract(epoch FROM claimed.last_slot_end) * 1000000)::bigint AS last_slot_end_us,"        \
  "  said.code AS last_code, said.confidence AS last_confidence, said.p AS last_p,"             \
  "  claimed.pv_flat_s, claimed.pv_step "                                                       \
  "FROM claimed JOIN chosen USING (loop_id) JOIN loopscope.loop USING (loop_id) "               \
  "LEFT JOIN LATERAL ("                                                                         \
  "  SELECT verdict.code, verdict.confidence, verdict.p FROM loopscope.verdict"                 \
  "  WHERE verdict.loop_id = claimed.loop_id AND verdict.slot_end = claimed.result_slot_end"    \
  "  ORDER BY verdict.algorithm_revision DESC, verdict.input_revision DESC LIMIT 1"             \
  ") AS said ON true ORDER BY loop_id"

// A time in microseconds, exactly.
#define LOOPSCOPE_TIME(PARAMETER) \
  "(timestamptz 'epoch' + " PARAMETER "::bigint * interval '1 microsecond')"

}  // namespace

// What would be the third lost lease in a row makes a loop a suspect: it may be what kills the
// workers, and is left out of the batches.
#define LOOPSCOPE_SUSPECT "due.lost_leases + (due.owner IS NOT NULL)::integer >= 3"

// Behind the place that the floor names (claim_floor.hpp); said twice, because the planner expects
// a third of the table of a comparison of rows, and few of one of times.
#define LOOPSCOPE_CLAIM_DUE(AND_MORE) \
  LOOPSCOPE_CLAIM(                                                                              \
      "FROM loopscope.schedule AS due "                                                         \
      "WHERE due.enabled AND due.visible_at <= now()"                                           \
      "  AND due.visible_at >= " LOOPSCOPE_TIME("$4")                                            \
      "  AND (due.visible_at, due.loop_id) > (" LOOPSCOPE_TIME("$4") ", $5::bigint)"            \
      "  AND NOT (" LOOPSCOPE_SUSPECT ") " AND_MORE                                             \
      "ORDER BY due.visible_at, due.loop_id LIMIT $3::bigint")

// A subquery for each row that is looked at: joined, it would read both tables as a whole.
#define LOOPSCOPE_ELSEWHERE(SOURCES)     \
  "(SELECT away.source <> ALL (" SOURCES \
  "::text[]) FROM loopscope.loop AS away WHERE away.loop_id = due.loop_id) "

const Statement kClaimDue{"claim_due", LOOPSCOPE_CLAIM_DUE("")};

const Statement kClaimDueElsewhere{"claim_due_elsewhere",
                                   LOOPSCOPE_CLAIM_DUE("AND " LOOPSCOPE_ELSEWHERE("$6"))};

// Seconds as the server counts them: what the way there takes says nothing of dead entries. What is
// locked is being claimed, or would not be claimed.
const Statement kOldestDue{
    "oldest_due",
    "SELECT oldest.due_us, oldest.loop_id,"
    "  extract(epoch FROM clock_timestamp() - statement_timestamp())::float8 AS took_s "
    "FROM (SELECT 1) AS always LEFT JOIN LATERAL ("
    "  SELECT (extract(epoch FROM due.visible_at) * 1000000)::bigint AS due_us, due.loop_id"
    "  FROM loopscope.schedule AS due "
    "  WHERE due.enabled AND due.visible_at >= " LOOPSCOPE_TIME("$1")
    "    AND due.visible_at <= least(" LOOPSCOPE_TIME("$2") ", now())"
    "    AND (due.visible_at, due.loop_id) <= (least(" LOOPSCOPE_TIME("$2") ", now()), $3::bigint)"
    "    AND NOT (" LOOPSCOPE_SUSPECT ") AND " LOOPSCOPE_ELSEWHERE("$4")
    "  ORDER BY due.visible_at, due.loop_id LIMIT 1 FOR UPDATE OF due SKIP LOCKED"
    ") AS oldest ON true",
    Rows::one};

// Few loops have lost two leases, and they have an index of their own (schedule_suspect).
const Statement kClaimSuspect{
    "claim_suspect",
    LOOPSCOPE_CLAIM("FROM loopscope.schedule AS due "
                    "WHERE due.enabled AND due.lost_leases >= 2 AND due.visible_at <= now()"
                    "  AND " LOOPSCOPE_SUSPECT " ORDER BY due.visible_at LIMIT 1")};

// A suspect that was alone when its worker died is left alone for a minute, then two, up to six
// hours.
const Statement kRestSuspects{"rest_suspects", R"(
    UPDATE loopscope.schedule AS s SET
      owner = NULL, attempts = least(s.attempts + 1, 1000000),
      lost_leases = least(s.lost_leases + 1, 1000000),
      visible_at = now() + least(60 * 2 ^ least(s.lost_leases - 3, 9), 21600) * interval '1 second',
      last_error = 'the lease of ' || s.owner || ' ended without a result, alone'
    WHERE s.loop_id = ANY (ARRAY(
      SELECT due.loop_id FROM loopscope.schedule AS due
      WHERE due.enabled AND due.lost_leases >= 3 AND due.visible_at <= now()
        AND due.owner IS NOT NULL
      FOR UPDATE SKIP LOCKED)))",
                              Rows::none};

// Of enabled loops, held ones included: then their lease ends.
const Statement kNextDue{
    "next_due",
    "SELECT extract(epoch FROM visible_at - now())::float8 AS due_in_s FROM loopscope.schedule "
    "WHERE enabled AND visible_at >= " LOOPSCOPE_TIME("$1")
    "  AND (visible_at, loop_id) > (" LOOPSCOPE_TIME("$1") ", $2::bigint)"
    "  AND visible_at <= now() + $3::float8 * interval '1 second' "
    "ORDER BY visible_at, loop_id LIMIT 1"};

// The row of a loop is the one with its highest fence: looked for from there, the versions that an
// old snapshot keeps are not passed.
const Statement kClaimNext{
    "claim_next",
    LOOPSCOPE_CLAIM("FROM loopscope.loop CROSS JOIN LATERAL ("
                    "  SELECT kept.ctid AS place FROM loopscope.schedule AS kept"
                    "  WHERE kept.loop_id = loop.loop_id ORDER BY kept.fence DESC LIMIT 1"
                    ") AS newest JOIN loopscope.schedule AS due ON due.ctid = newest.place "
                    "WHERE due.enabled AND loop.loop_id > $4::bigint"
                    "  AND (due.owner IS NULL OR due.visible_at <= now())"
                    "  AND NOT (" LOOPSCOPE_SUSPECT ") "
                    "ORDER BY loop.loop_id LIMIT $3::bigint")};

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

const Statement kSeeWorker{"see_worker", R"(
    INSERT INTO loopscope.worker AS kept (worker, program_version, algorithm_revision, held_loops,
                                          lost_leases)
    VALUES ($1, $2, $3::integer, $4::integer, $5::bigint)
    ON CONFLICT (worker) DO UPDATE SET
      program_version = EXCLUDED.program_version,
      algorithm_revision = EXCLUDED.algorithm_revision, last_seen = now(),
      held_loops = EXCLUDED.held_loops, lost_leases = EXCLUDED.lost_leases)",
                           Rows::none};

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
    FROM stray)"};

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
    RETURNING s.loop_id)"};

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

const Statement kCountEnabled{"count_enabled_loops",
                              "SELECT count(*) FROM loopscope.loop WHERE enabled", Rows::one};

// A loop that a worker holds becomes due when the worker is done with it.
const Statement kMakeDue{"make_due", R"(
    UPDATE loopscope.schedule SET visible_at = now()
    WHERE loop_id = ANY ($1::bigint[]) AND owner IS NULL)",
                         Rows::none};

}  // namespace loopscope::storage::statements
