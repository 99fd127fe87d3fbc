#include "storage/results/reports/analysis_archive.hpp"

#include "storage/results/rows/loop_row.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/session.hpp"
#include "storage/results/writes/analysis_statements.hpp"

namespace loopscope::storage {
namespace {

const Statement& find_analysis() {
  static const Statement statement{
      "find_analysis", "SELECT " LOOPSCOPE_LOOP_COLUMNS R"(,
           (extract(epoch FROM stored.slot_end) * 1000000)::bigint AS slot_end_us,
           stored.algorithm_revision, stored.input_revision, stored.input_digest,
           stored.program_version, stored.settings, stored.past_pv_flat_s AS pv_flat_s,
           stored.past_pv_step AS pv_step, stored.model IS NOT NULL AS modelled,
           ()" + measured_object("stored") +
                           R"() || jsonb_build_object('verdict', said.words, 'peaks', peak.list,
                              'steps', step.list) AS figures
    FROM loopscope.analysis AS stored
    JOIN loopscope.loop ON loop.loop_id = stored.loop_id
    CROSS JOIN LATERAL (
      SELECT jsonb_build_object('code', code, 'confidence', confidence, 'p', p, 'summary', summary,
                                'reasons', reasons, 'action', action) AS words
      FROM loopscope.verdict AS v
      WHERE v.loop_id = stored.loop_id AND v.slot_end = stored.slot_end
        AND v.algorithm_revision = stored.algorithm_revision
        AND v.input_revision = stored.input_revision) AS said
    CROSS JOIN LATERAL (
      SELECT coalesce(jsonb_agg(jsonb_build_object('f1', f1, 'f2', f2, 'bic2', bic2, 'p', p)
                                ORDER BY rank), '[]') AS list
      FROM loopscope.bicoherence_peak AS b
      WHERE b.loop_id = stored.loop_id AND b.slot_end = stored.slot_end
        AND b.algorithm_revision = stored.algorithm_revision
        AND b.input_revision = stored.input_revision) AS peak
    CROSS JOIN LATERAL (
      SELECT coalesce(jsonb_agg(to_jsonb(e) - '{loop_id,slot_end,algorithm_revision,input_revision,step}'::text[]
                                ORDER BY step), '[]') AS list
      FROM loopscope.explanation_step AS e
      WHERE e.loop_id = stored.loop_id AND e.slot_end = stored.slot_end
        AND e.algorithm_revision = stored.algorithm_revision
        AND e.input_revision = stored.input_revision) AS step
    WHERE stored.analysis_id = $1::bigint)"};
  return statement;
}

StoredAnalysis read(const pqxx::row& row) {
  StoredAnalysis analysis;
  analysis.loop = read_loop(row);
  analysis.slot_end_us = row["slot_end_us"].as<std::int64_t>();
  analysis.algorithm_revision = row["algorithm_revision"].as<int>();
  analysis.input_revision = row["input_revision"].as<int>();
  analysis.input_digest = read_text(row["input_digest"]);
  analysis.program_version = read_text(row["program_version"]);
  analysis.settings_json = read_text(row["settings"]);
  analysis.pv_past = read_pv_past(row);
  analysis.modelled = row["modelled"].as<bool>();
  analysis.figures_json = read_text(row["figures"]);
  return analysis;
}

}  // namespace

struct AnalysisArchive::Impl {
  explicit Impl(const ConnectionSettings& settings) : session(settings) {
    require_schema_version(session);
  }
  Session session;
};

AnalysisArchive::AnalysisArchive(const ConnectionSettings& settings)
    : impl_(std::make_unique<Impl>(settings)) {}
AnalysisArchive::~AnalysisArchive() = default;

std::optional<StoredAnalysis> AnalysisArchive::find(std::int64_t analysis_id) {
  return impl_->session.transact([&](Transaction& transaction) -> std::optional<StoredAnalysis> {
    const pqxx::result rows = transaction.run(find_analysis(), {std::to_string(analysis_id)});
    if (rows.empty()) return std::nullopt;
    return read(rows[0]);
  });
}

std::string AnalysisArchive::measured_columns(const AnalysisRecord& record) {
  CompletedLoop loop;
  loop.record = record;
  return impl_->session.transact([&](Transaction& transaction) {
    return read_text(transaction.run(measure_analyses(), analysis_parameters({&loop}))[0][0]);
  });
}

}  // namespace loopscope::storage
