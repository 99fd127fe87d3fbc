#include "storage/results/writes/write_results.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/diagnosis/odds/combined_odds.hpp"
#include "storage/array_literal.hpp"
#include "storage/results/writes/analysis_statements.hpp"
#include "storage/results/writes/combine_newest.hpp"
#include "storage/results/writes/write_combined.hpp"

namespace loopscope::storage {
namespace {

const Statement kInsertVerdicts{"insert_verdicts", R"(
    INSERT INTO loopscope.verdict (loop_id, slot_end, algorithm_revision, input_revision,
                                   analysis_id, code, confidence, p, summary, reasons,
                                   action, cause_probabilities, cause_evidence)
    SELECT loop_id, slot_end, algorithm_revision, input_revision,
           analysis_id, code, confidence, p, summary, reasons::text[], action, causes::real[],
           evidence::real[]
    FROM unnest($1::bigint[], $2::timestamptz[], $3::integer[], $4::integer[],
                $5::bigint[], $6::text[], $7::float8[], $8::float8[], $9::text[], $10::text[],
                $11::text[], $12::text[], $13::text[])
      AS row (loop_id, slot_end, algorithm_revision, input_revision, analysis_id, code, confidence,
              p, summary, reasons, action, causes, evidence))",
                                Rows::none, Kept::plan};

const Statement kInsertPeaks{"insert_peaks", R"(
    INSERT INTO loopscope.bicoherence_peak (loop_id, slot_end, algorithm_revision, input_revision,
                                            rank, f1, f2, bic2, p)
    SELECT * FROM unnest($1::bigint[], $2::timestamptz[], $3::integer[], $4::integer[],
                         $5::integer[], $6::float8[], $7::float8[], $8::float8[], $9::float8[]))",
                             Rows::none, Kept::plan};

// Figures that are null in JSON become NULL; jsonb keeps every digit of the others.
const Statement kInsertSteps{"insert_steps", R"(
    INSERT INTO loopscope.explanation_step (loop_id, slot_end, algorithm_revision, input_revision,
                                            step, effect, parameters, intervals,
                                            holdout_error_before, holdout_error_after, evidence, p,
                                            margin, simulation_ratio, steadiness, statement,
                                            asked_by)
    SELECT loop_id, slot_end, algorithm_revision, input_revision,
           number, taken->>'effect', taken->'parameters', taken->'intervals',
           (taken->>'holdout_error_before')::float8, (taken->>'holdout_error_after')::float8,
           (taken->>'evidence')::float8, (taken->>'p')::float8, (taken->>'margin')::float8,
           (taken->>'simulation_ratio')::float8, (taken->>'steadiness')::float8,
           taken->>'statement', taken->'asked_by'
    FROM unnest($1::bigint[], $2::timestamptz[], $3::integer[], $4::integer[], $5::text[])
      AS row (loop_id, slot_end, algorithm_revision, input_revision, model)
    CROSS JOIN jsonb_array_elements(model::jsonb->'steps') WITH ORDINALITY AS s (taken, number))",
                             Rows::none, Kept::plan};

/// An analysis row that was written in this transaction.
struct WrittenAnalysis {
  const CompletedLoop* loop = nullptr;
  bool is_combined = false;
  std::int64_t input_revision = 0;
  std::int64_t analysis_id = 0;
};

std::vector<WrittenAnalysis> upsert(Transaction& transaction,
                                    const std::vector<const CompletedLoop*>& loops) {
  const std::vector<std::optional<Combined>> combined = combine_newest(transaction, loops);
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> by_key;
  for (std::size_t i = 0; i < loops.size(); ++i)
    by_key[{loops[i]->loop_id, loops[i]->record->slot_end_us}] = i;
  std::vector<WrittenAnalysis> written;
  for (const pqxx::row& row :
       transaction.run(upsert_analyses(), upsert_parameters(loops, combined))) {
    const std::size_t i =
        by_key.at({row["loop_id"].as<std::int64_t>(), row["slot_end_us"].as<std::int64_t>()});
    written.push_back({loops[i], combined[i].has_value(), row["input_revision"].as<std::int64_t>(),
                       row["analysis_id"].as<std::int64_t>()});
  }
  return written;
}

/// The four columns that the tables beside analysis share.
struct KeyArrays {
  ArrayLiteral loop_id, slot_end, algorithm_revision, input_revision;

  void add(const WrittenAnalysis& written) {
    loop_id.add_integer(written.loop->loop_id);
    slot_end.add_time(written.loop->record->slot_end_us);
    algorithm_revision.add_integer(written.loop->record->algorithm_revision);
    input_revision.add_integer(written.input_revision);
  }
};

/// A confidence that is no share of 1 would be refused, and the whole batch with it.
double confidence_of(const core::diagnosis::Verdict& verdict) {
  return verdict.confidence >= 0.0 ? std::min(verdict.confidence, 1.0) : 0.0;
}

/// NULL says "no test"; a p-value that is no number says that nothing was shown.
std::optional<double> p_of(const core::diagnosis::Verdict& verdict) {
  if (!verdict.p) return std::nullopt;
  return *verdict.p >= 0.0 ? std::min(*verdict.p, 1.0) : 1.0;
}

void insert_verdicts(Transaction& transaction, const std::vector<WrittenAnalysis>& analyses) {
  KeyArrays key;
  ArrayLiteral analysis_id, code, confidence, p, summary, reasons, action, causes, evidence;
  for (const WrittenAnalysis& written : analyses) {
    const core::diagnosis::Verdict& verdict = written.loop->record->diagnosis.verdict;
    key.add(written);
    analysis_id.add_integer(written.analysis_id);
    code.add_text(core::diagnosis::name(verdict.code));
    confidence.add_number(confidence_of(verdict));
    p.add_number(p_of(verdict));
    summary.add_text(verdict.summary);
    reasons.add_text_list(verdict.reasons);
    action.add_text(verdict.action);
    causes.add_real_list(core::diagnosis::probabilities_of(verdict));
    evidence.add_real_list(core::diagnosis::evidence_of(verdict));
  }
  transaction.run(
      kInsertVerdicts,
      {key.loop_id.text(), key.slot_end.text(), key.algorithm_revision.text(),
       key.input_revision.text(), analysis_id.text(), code.text(), confidence.text(), p.text(),
       summary.text(), reasons.text(), action.text(), causes.text(), evidence.text()});
}

void insert_peaks(Transaction& transaction, const std::vector<WrittenAnalysis>& analyses) {
  KeyArrays key;
  ArrayLiteral rank, f1, f2, bic2, p;
  for (const WrittenAnalysis& written : analyses) {
    const auto& hos = written.loop->record->diagnosis.evidence.hos;
    for (std::size_t i = 0; hos && i < hos->peaks.size(); ++i) {
      const core::hos::Peak& peak = hos->peaks[i];
      key.add(written);
      rank.add_integer(static_cast<std::int64_t>(i) + 1);
      f1.add_number(peak.f1);
      f2.add_number(peak.f2);
      bic2.add_number(peak.bic2);
      p.add_number(peak.p);
    }
  }
  if (rank.empty()) return;
  transaction.run(kInsertPeaks, {key.loop_id.text(), key.slot_end.text(),
                                 key.algorithm_revision.text(), key.input_revision.text(),
                                 rank.text(), f1.text(), f2.text(), bic2.text(), p.text()});
}

/// One row for each effect that a loop model took in.
void insert_steps(Transaction& transaction, const std::vector<WrittenAnalysis>& analyses) {
  KeyArrays key;
  ArrayLiteral model;
  for (const WrittenAnalysis& written : analyses) {
    if (written.loop->record->model_json.empty()) continue;
    key.add(written);
    model.add_text(written.loop->record->model_json);
  }
  if (model.empty()) return;
  transaction.run(kInsertSteps,
                  {key.loop_id.text(), key.slot_end.text(), key.algorithm_revision.text(),
                   key.input_revision.text(), model.text()});
}

/// What was not combined with its row: slots that others stand behind.
void combine_windows(Transaction& transaction, const std::vector<WrittenAnalysis>& analyses) {
  // All windows of a batch are judged by the same settings.
  const core::diagnosis::PerCause& priors = analyses.front().loop->record->diagnosis.verdict.priors;
  std::map<int, std::map<std::int64_t, ChangedSlots>> changed;  // by algorithm revision
  for (const WrittenAnalysis& written : analyses) {
    if (written.is_combined) continue;
    const AnalysisRecord& record = *written.loop->record;
    const ChangedSlots own = changed_by(record);
    ChangedSlots& slots =
        changed[record.algorithm_revision].try_emplace(written.loop->loop_id, own).first->second;
    slots = {std::min(slots.first_us, own.first_us), std::min(slots.earliest_us, own.earliest_us)};
  }
  for (const auto& [revision, loops] : changed)
    write_combined(transaction, revision, loops, priors);
}

}  // namespace

WriteCount write_records(Transaction& transaction, const std::vector<const CompletedLoop*>& loops) {
  WriteCount count;
  if (loops.empty()) return count;
  const std::vector<WrittenAnalysis> written = upsert(transaction, loops);
  count.unchanged = loops.size() - written.size();
  if (written.empty()) return count;
  insert_verdicts(transaction, written);
  insert_peaks(transaction, written);
  insert_steps(transaction, written);
  combine_windows(transaction, written);
  const auto is_new = [](const WrittenAnalysis& analysis) { return analysis.input_revision == 1; };
  count.inserted = static_cast<std::size_t>(std::ranges::count_if(written, is_new));
  count.revised = written.size() - count.inserted;
  return count;
}

}  // namespace loopscope::storage
