#include "storage/results/catalogue/delete_loops.hpp"

#include <cstdint>

#include "storage/array_literal.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

// A lock on its schedule row keeps workers from claiming a loop, who pass over what is locked; who
// is about to finish one is waited for.
const Statement kLockLoops{"lock_loops", R"(
    SELECT kept.loop_id, loop.name,
           kept.owner IS NOT NULL AND kept.visible_at > now() AS is_held
    FROM loopscope.schedule AS kept JOIN loopscope.loop USING (loop_id)
    WHERE loop.name = ANY ($1::text[])
    ORDER BY kept.loop_id FOR UPDATE OF kept)"};

const Statement kCountResults{"count_results", R"(
    SELECT (SELECT count(*) FROM loopscope.analysis WHERE loop_id = one.id) AS analyses,
           (SELECT count(*) FROM loopscope.annotation WHERE loop_id = one.id) AS annotations,
           (SELECT count(*) FROM loopscope.maintenance_event WHERE loop_id = one.id) AS events
    FROM unnest($1::bigint[]) AS one (id))"};

// What a round found stays as far as it does not rest on the loop.
const Statement kDeleteOscillations{"delete_oscillations", R"(
    DELETE FROM loopscope.plant_oscillation
    WHERE loop_ids && $1::bigint[]
      AND (source_loop_id = ANY ($1::bigint[])
           OR (SELECT count(*) FROM unnest(loop_ids) AS id WHERE id <> ALL ($1::bigint[])) < 2))",
                                    Rows::none};

const Statement kLeaveOscillations{"leave_oscillations", R"(
    UPDATE loopscope.plant_oscillation AS kept SET
      (loop_ids, strengths, lags_s, roles, scores, reasons) = (
        SELECT array_agg(kept.loop_ids[k] ORDER BY k), array_agg(kept.strengths[k] ORDER BY k),
               array_agg(kept.lags_s[k] ORDER BY k),
               CASE WHEN kept.roles IS NOT NULL THEN array_agg(kept.roles[k] ORDER BY k) END,
               CASE WHEN kept.scores IS NOT NULL THEN array_agg(kept.scores[k] ORDER BY k) END,
               CASE WHEN kept.reasons IS NOT NULL THEN array_agg(kept.reasons[k] ORDER BY k) END
        FROM generate_subscripts(kept.loop_ids, 1) AS k
        WHERE kept.loop_ids[k] <> ALL ($1::bigint[])),
      leads = CASE WHEN kept.leads IS NOT NULL THEN (
        SELECT coalesce(jsonb_agg(lead ORDER BY place), '[]')
        FROM jsonb_array_elements(kept.leads) WITH ORDINALITY AS one (lead, place)
        WHERE (lead ->> 'from_loop_id' = ANY ($1::bigint[]::text[])
               OR lead ->> 'to_loop_id' = ANY ($1::bigint[]::text[])) IS NOT TRUE) END,
      traces = CASE WHEN kept.traces IS NOT NULL THEN (
        SELECT coalesce(jsonb_agg(trace ORDER BY place), '[]')
        FROM jsonb_array_elements(kept.traces) WITH ORDINALITY AS one (trace, place)
        WHERE (trace ->> 'loop_id' = ANY ($1::bigint[]::text[])) IS NOT TRUE) END
    WHERE kept.loop_ids && $1::bigint[])",
                                   Rows::none};

// These have no key of the loop's that would delete them with it.
const Statement kDeletePeaks{"delete_peaks",
                             "DELETE FROM loopscope.bicoherence_peak WHERE loop_id = $1::bigint",
                             Rows::none};
const Statement kDeleteSteps{"delete_steps",
                             "DELETE FROM loopscope.explanation_step WHERE loop_id = $1::bigint",
                             Rows::none};
const Statement kDeleteVerdicts{
    "delete_verdicts", "DELETE FROM loopscope.verdict WHERE loop_id = $1::bigint", Rows::none};
// All else goes by its key: schedule, analyses, annotations, work, problems, notices.
const Statement kDeleteLoop{"delete_loop", "DELETE FROM loopscope.loop WHERE loop_id = $1::bigint",
                            Rows::none};

std::vector<std::int64_t> lock(Transaction& transaction, const std::string& names,
                               LoopsDeletion& deletion) {
  std::vector<std::int64_t> loop_ids;
  for (const pqxx::row& row : transaction.run(kLockLoops, {names})) {
    loop_ids.push_back(row["loop_id"].as<std::int64_t>());
    if (row["is_held"].as<bool>()) deletion.held.emplace_back(row["name"].c_str());
  }
  deletion.loops = loop_ids.size();
  return loop_ids;
}

void count(Transaction& transaction, const std::string& ids, LoopsDeletion& deletion) {
  for (const pqxx::row& row : transaction.run(kCountResults, {ids})) {
    const auto analyses = row["analyses"].as<std::size_t>();
    const auto annotations = row["annotations"].as<std::size_t>();
    const auto events = row["events"].as<std::size_t>();
    deletion.analyses += analyses;
    deletion.annotations += annotations;
    deletion.maintenance_events += events;
    if (analyses + annotations + events > 0) ++deletion.with_results;
  }
}

/// A loop at a time: each statement is short, however long their histories are.
void delete_all(Transaction& transaction, const std::vector<std::int64_t>& loop_ids,
                const std::string& ids) {
  transaction.run(kDeleteOscillations, {ids});
  transaction.run(kLeaveOscillations, {ids});
  for (const std::int64_t loop_id : loop_ids) {
    const std::vector<std::string> one{std::to_string(loop_id)};
    for (const Statement* statement :
         {&kDeletePeaks, &kDeleteSteps, &kDeleteVerdicts, &kDeleteLoop})
      transaction.run(*statement, one);
  }
}

}  // namespace

LoopsDeletion delete_loops(const ConnectionSettings& settings, std::span<const std::string> names,
                           bool with_results) {
  Session session(settings);
  require_schema_version(session);
  ArrayLiteral wanted;
  for (const std::string& name : names) wanted.add_text(name);
  return session.transact([&](Transaction& transaction) {
    LoopsDeletion deletion;
    const std::vector<std::int64_t> loop_ids = lock(transaction, wanted.text(), deletion);
    ArrayLiteral ids;
    for (const std::int64_t loop_id : loop_ids) ids.add_integer(loop_id);
    count(transaction, ids.text(), deletion);
    if (!deletion.held.empty() || (deletion.with_results > 0 && !with_results)) return deletion;
    delete_all(transaction, loop_ids, ids.text());
    deletion.deleted = true;
    return deletion;
  });
}

}  // namespace loopscope::storage
