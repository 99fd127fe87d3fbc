#include "storage/results/plant/plant_candidates.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "storage/results/rows/loop_row.hpp"
#include "storage/results/session/session.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

// schedule.result_slot_end names the slot, so that one partition is probed per loop (own_verdict
// does the same, but has no tags).
const Statement kPlantCandidates{"plant_candidates", "SELECT " LOOPSCOPE_LOOP_COLUMNS R"(,
      (extract(epoch FROM analysis.slot_end) * 1000000)::bigint AS slot_end_us,
      analysis.oscillating, said.code, said.confidence, said.cause_probabilities
    FROM loopscope.schedule
    JOIN loopscope.loop USING (loop_id)
    CROSS JOIN LATERAL (
      SELECT * FROM loopscope.analysis AS stored
      WHERE stored.loop_id = schedule.loop_id AND stored.slot_end = schedule.result_slot_end
      ORDER BY stored.algorithm_revision DESC LIMIT 1) AS analysis
    CROSS JOIN LATERAL (
      SELECT verdict.code, verdict.confidence, verdict.cause_probabilities FROM loopscope.verdict
      WHERE verdict.loop_id = analysis.loop_id AND verdict.slot_end = analysis.slot_end
        AND verdict.algorithm_revision = analysis.algorithm_revision
        AND verdict.input_revision = analysis.input_revision) AS said
    WHERE schedule.enabled AND analysis.usable
      AND schedule.result_slot_end >= $1::timestamptz - 3 * loop.period_s * interval '1 second'
    ORDER BY analysis.oscillating DESC, analysis.oscillation_p, loop.loop_id
    LIMIT $2::bigint)"};

std::vector<core::diagnosis::CauseReport> read_causes(const pqxx::field& field) {
  const core::diagnosis::PerCause probabilities = read_number_list(field);
  std::vector<core::diagnosis::CauseReport> causes;
  // A later program's causes, if it has more, are not known here.
  const auto codes = core::diagnosis::all_verdict_codes();
  for (std::size_t k = 0; k < std::min(probabilities.size(), codes.size()); ++k)
    if (probabilities[k]) {
      core::diagnosis::CauseReport& cause = causes.emplace_back();
      cause.code = codes[k];
      cause.probability = *probabilities[k];
    }
  return causes;
}

PlantCandidate read_candidate(const pqxx::row& row) {
  using core::diagnosis::VerdictCode;
  PlantCandidate candidate;
  candidate.loop = read_loop(row);
  candidate.slot_end_us = row["slot_end_us"].as<std::int64_t>();
  candidate.oscillating = row["oscillating"].as<bool>();
  candidate.verdict.code =
      core::diagnosis::verdict_code(row["code"].c_str()).value_or(VerdictCode::unexplained);
  candidate.verdict.confidence = row["confidence"].as<double>();
  candidate.verdict.causes = read_causes(row["cause_probabilities"]);
  return candidate;
}

}  // namespace

std::vector<PlantCandidate> plant_candidates(Session& session, std::int64_t slot_end_us,
                                             std::int64_t limit) {
  return session.transact([&](Transaction& transaction) {
    const pqxx::result rows =
        transaction.run(kPlantCandidates, {timestamp_text(slot_end_us), std::to_string(limit)});
    std::vector<PlantCandidate> candidates;
    candidates.reserve(static_cast<std::size_t>(rows.size()));
    for (const pqxx::row& row : rows) candidates.push_back(read_candidate(row));
    return candidates;
  });
}

}  // namespace loopscope::storage
