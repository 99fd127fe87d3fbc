#include "storage/results/plant_candidates.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "storage/results/cause_values.hpp"
#include "storage/results/loop_columns.hpp"
#include "storage/results/loop_row.hpp"
#include "storage/results/session.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

// schedule.result_slot_end names the slot, so that one partition is probed per loop (latest_verdict
// does the same, but has neither the tags nor the slow look). `steps` holds effect, error before
// and error after of each step, blanks between them: no effect has one in its name.
const Statement kPlantCandidates{"plant_candidates", "SELECT " LOOPSCOPE_LOOP_COLUMNS R"(,
      (extract(epoch FROM analysis.slot_end) * 1000000)::bigint AS slot_end_us,
      analysis.oscillating, analysis.oscillation_period_s, analysis.oscillation_regularity,
      analysis.oscillation_amplitude, analysis.oscillation_persistence, analysis.oscillation_p,
      analysis.nonlinear_p, analysis.cubic_p, analysis.hos_slow IS NOT NULL AS looked_twice,
      (analysis.hos_slow->>'nonlinear_p')::float8 AS slow_nonlinear_p,
      (analysis.hos_slow->>'cubic_p')::float8 AS slow_cubic_p,
      said.code, said.confidence, said.cause_probabilities, taken.steps
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
    CROSS JOIN LATERAL (
      SELECT string_agg(effect || ' ' || holdout_error_before || ' ' || holdout_error_after, ' '
                        ORDER BY step) AS steps
      FROM loopscope.explanation_step AS e
      WHERE e.loop_id = analysis.loop_id AND e.slot_end = analysis.slot_end
        AND e.algorithm_revision = analysis.algorithm_revision
        AND e.input_revision = analysis.input_revision) AS taken
    WHERE schedule.enabled AND analysis.usable
      AND schedule.result_slot_end >= $1::timestamptz - 3 * loop.period_s * interval '1 second'
    ORDER BY analysis.oscillating DESC, analysis.oscillation_p, loop.loop_id
    LIMIT $2::bigint)"};

/// The next word of a text, which is cut off there.
std::string next_word(std::string_view& text) {
  const std::size_t end = std::min(text.find(' '), text.size());
  std::string word(text.substr(0, end));
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

std::optional<core::model::Explanation> read_model(std::string_view steps) {
  if (steps.empty()) return std::nullopt;
  core::model::Explanation model;
  while (!steps.empty()) {
    const std::string effect = next_word(steps);
    core::model::Step step;
    step.holdout_error_before = std::stod(next_word(steps));
    step.holdout_error_after = std::stod(next_word(steps));
    const auto kinds = core::model::all_effect_kinds();
    const auto kind = std::ranges::find(
        kinds, effect, [](core::model::EffectKind one) { return core::model::name(one); });
    if (kind == kinds.end()) continue;  // a later program wrote it
    step.effect = *kind;
    model.steps.push_back(step);
  }
  return model;
}

core::loop::Oscillation read_oscillation(const pqxx::row& row) {
  return {row["oscillating"].as<bool>(),
          read_number(row["oscillation_period_s"]),
          read_number(row["oscillation_regularity"]),
          read_number(row["oscillation_amplitude"]),
          read_number(row["oscillation_persistence"]),
          read_number(row["oscillation_p"])};
}

core::Evidence read_evidence(const pqxx::row& row) {
  core::Evidence evidence;
  evidence.oscillation = read_oscillation(row);
  evidence.hos.emplace();
  evidence.hos->nonlinear_p = read_number(row["nonlinear_p"]);
  evidence.hos->cubic_p = read_number(row["cubic_p"]);
  if (row["looked_twice"].as<bool>()) {
    evidence.hos_slow.emplace();
    evidence.hos_slow->result.nonlinear_p = read_number(row["slow_nonlinear_p"]);
    evidence.hos_slow->result.cubic_p = read_number(row["slow_cubic_p"]);
  }
  evidence.model = read_model(row["steps"].c_str());
  return evidence;
}

std::vector<core::diagnosis::CauseReport> read_causes(const pqxx::field& field) {
  const core::diagnosis::PerCause probabilities = read_cause_values(field);
  std::vector<core::diagnosis::CauseReport> causes;
  for (std::size_t k = 0; k < probabilities.size(); ++k)
    if (probabilities[k]) {
      core::diagnosis::CauseReport& cause = causes.emplace_back();
      cause.code = core::diagnosis::all_verdict_codes()[k];
      cause.probability = *probabilities[k];
    }
  return causes;
}

PlantCandidate read_candidate(const pqxx::row& row) {
  using core::diagnosis::VerdictCode;
  PlantCandidate candidate;
  candidate.loop = read_loop(row);
  candidate.slot_end_us = row["slot_end_us"].as<std::int64_t>();
  candidate.evidence = read_evidence(row);
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
    std::vector<PlantCandidate> candidates;
    for (const pqxx::row& row :
         transaction.run(kPlantCandidates, {timestamp_text(slot_end_us), std::to_string(limit)})) {
      candidates.push_back(read_candidate(row));
    }
    return candidates;
  });
}

}  // namespace loopscope::storage
