#pragma once

#include <optional>
#include <pqxx/pqxx>
#include <vector>

#include "storage/loop_work.hpp"
#include "storage/results/rows/loop_row.hpp"

// The statement that every claim is made of, and the rows that it returns.

/// A claim is ONE statement. The chosen rows are locked first and then updated by their place in
/// the table (ctid): joined as a subquery they cost a scan of the whole table under an unlucky
/// plan, and by key a look at every version that an old snapshot keeps. A claim that finds an owner
/// takes over from a worker that was lost: that counts as a failure and as a lost lease, so that a
/// loop which kills its workers is noticed. Only the database's clock is used. $1 is the owner, $2
/// for how many seconds; END says until when the claim holds.
#define LOOPSCOPE_CLAIM_UNTIL(END, CHOICE)                                                      \
  "WITH chosen AS MATERIALIZED (SELECT due.ctid AS place, due.loop_id, due.visible_at " CHOICE  \
  " FOR UPDATE OF due SKIP LOCKED), claimed AS ("                                               \
  "  UPDATE loopscope.schedule AS s SET"                                                        \
  "    owner = $1, fence = s.fence + 1, visible_at = " END                                      \
  ","                                                                                           \
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
  "  (extract(epoch FROM least(chosen.visible_at, '9999-12-31 UTC')) * 1000000)::bigint"        \
  "    AS due_us,"                                                                              \
  "  (extract(epoch FROM claimed.last_slot_end) * 1000000)::bigint AS last_slot_end_us,"        \
  "  said.code AS last_code, said.confidence AS last_confidence, said.p AS last_p,"             \
  "  claimed.pv_flat_s, claimed.pv_step "                                                       \
  "FROM claimed JOIN chosen USING (loop_id) JOIN loopscope.loop USING (loop_id) "               \
  "LEFT JOIN LATERAL ("                                                                         \
  "  SELECT verdict.code, verdict.confidence, verdict.p FROM loopscope.verdict"                 \
  "  WHERE verdict.loop_id = claimed.loop_id AND verdict.slot_end = claimed.result_slot_end"    \
  "  ORDER BY verdict.algorithm_revision DESC, verdict.input_revision DESC LIMIT 1"             \
  ") AS said ON true ORDER BY loop_id"

#define LOOPSCOPE_CLAIM(CHOICE) \
  LOOPSCOPE_CLAIM_UNTIL("now() + $2::float8 * interval '1 second'", CHOICE)

/// What would be the third lost lease in a row makes a loop a suspect: it may be what kills the
/// workers, and is left out of the batches.
#define LOOPSCOPE_SUSPECT "due.lost_leases + (due.owner IS NOT NULL)::integer >= 3"

/// The row of a loop is the one with its highest fence: looked for from there, the versions that an
/// old snapshot keeps are not passed. LOOP_ID is an expression, the row goes by the name due.
#define LOOPSCOPE_NEWEST_SCHEDULE(LOOP_ID)                      \
  " CROSS JOIN LATERAL ("                                       \
  "  SELECT kept.ctid AS place FROM loopscope.schedule AS kept" \
  "  WHERE kept.loop_id = " LOOP_ID                             \
  " ORDER BY kept.fence DESC LIMIT 1"                           \
  ") AS newest JOIN loopscope.schedule AS due ON due.ctid = newest.place "

namespace loopscope::storage {

/// The verdict in the columns last_code, last_confidence and last_p; nullopt for NULL, and for one
/// that only a later program knows. Throws what read_loop() throws, as the next does.
[[nodiscard]] std::optional<LastVerdict> read_last_verdict(const pqxx::row& row);

[[nodiscard]] std::vector<ClaimedLoop> read_claims(const pqxx::result& rows);
[[nodiscard]] ClaimedLoop read_claim(const pqxx::row& row);

}  // namespace loopscope::storage
