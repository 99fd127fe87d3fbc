#include "storage/results/catalogue/repair_judgements.hpp"

#include <cmath>
#include <map>
#include <string>

#include "core/diagnosis/diagnose.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "storage/array_literal.hpp"
#include "storage/results/catalogue/repair_figures.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/session.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

/// $1 = algorithm revision, $2 = behind which piece of work, $3 = how many. A row per piece of
/// work. Which work a loop has seen is compared by its text, not by times: clocks are set, and a
/// transaction commits later than it began.
const Statement kDueRepairs{"due_repairs", R"(
    WITH setting AS (
      SELECT coalesce(max(value), 0) AS min_confidence
      FROM loopscope.parameter WHERE name = 'min_confidence'
    ), work AS MATERIALIZED (
      SELECT maintenance_event_id, loop_id, max(done_at) OVER of_loop AS last_done_at,
             md5(string_agg(maintenance_event_id || ' ' || extract(epoch FROM done_at), ',')
                   OVER of_loop) AS works
      FROM loopscope.maintenance_event
      WINDOW of_loop AS (PARTITION BY loop_id ORDER BY maintenance_event_id
                         ROWS BETWEEN UNBOUNDED PRECEDING AND UNBOUNDED FOLLOWING)
    ), due AS MATERIALIZED (
      SELECT work.maintenance_event_id, work.loop_id, schedule.result_slot_end, work.works
      FROM work
      JOIN loopscope.schedule USING (loop_id)
      CROSS JOIN setting
      LEFT JOIN loopscope.repair_judgement AS known USING (maintenance_event_id)
      WHERE work.maintenance_event_id > $2::bigint
        AND (known.maintenance_event_id IS NULL
             OR known.works <> work.works
             OR (work.last_done_at > now() - interval '1 year'
                 AND (known.newest_slot_end IS DISTINCT FROM schedule.result_slot_end
                      OR known.algorithm_revision < $1::integer
                      OR known.min_confidence <> setting.min_confidence)))
      ORDER BY work.maintenance_event_id
      LIMIT $3::bigint
    )
    SELECT due.maintenance_event_id, setting.min_confidence, due.works,
           (extract(epoch FROM due.result_slot_end) * 1000000)::bigint AS newest_slot_end_us,
           refused.unusable_reason, newest.code AS newest_code,
           newest.confidence AS newest_confidence,
           to_char(newest.slot_end AT TIME ZONE 'UTC', 'YYYY-MM-DD HH24:MI') AS newest_slot
    FROM due
    CROSS JOIN setting
    CROSS JOIN LATERAL (
      SELECT * FROM loopscope.maintenance_job AS own
      WHERE own.maintenance_event_id = due.maintenance_event_id OFFSET 0) AS job
    LEFT JOIN LATERAL (
      SELECT unusable_reason FROM loopscope.analysis
      WHERE loop_id = due.loop_id AND slot_end > job.ends_at AND window_start >= job.ends_at
        AND (job.next_at IS NULL OR slot_end <= job.next_at) AND NOT usable
      ORDER BY slot_end DESC LIMIT 1) AS refused ON true
    LEFT JOIN LATERAL (
      SELECT analysis.slot_end, verdict.code, verdict.confidence FROM loopscope.analysis
      JOIN loopscope.verdict USING (loop_id, slot_end, algorithm_revision, input_revision)
      WHERE analysis.loop_id = due.loop_id AND analysis.slot_end > job.ends_at
        AND analysis.window_start >= job.ends_at
        AND (job.next_at IS NULL OR analysis.slot_end <= job.next_at) AND analysis.usable
      ORDER BY analysis.slot_end DESC, analysis.algorithm_revision DESC LIMIT 1) AS newest ON true
    ORDER BY due.maintenance_event_id)"};

/// $1 = bigint[] of maintenance_event_id. A row per window, nearest to the work first. OFFSET 0
/// keeps the planner from joining the windows of all work there is (3.3 s instead of 0.03 s).
const Statement kRepairWindows{"repair_windows", R"(
    SELECT asked.id AS maintenance_event_id, shown.side, shown.code, shown.confidence,
           shown.error_std, shown.error_log_variance_se, shown.harris, shown.ngi, shown.nli,
           shown.nonlinear_p, coalesce(shown.oscillating, false) AS oscillating,
           shown.oscillation_amplitude, shown.valve_travel_per_h, shown.controller_gain,
           shown.integral_time_s, fitted.effects, fitted.parameters, fitted.values
    FROM unnest($1::bigint[]) AS asked (id)
    CROSS JOIN LATERAL (
      SELECT * FROM loopscope.maintenance_window AS near
      WHERE near.maintenance_event_id = asked.id OFFSET 0) AS shown
    CROSS JOIN LATERAL (
      SELECT array_agg(step.effect ORDER BY step.step, each.key) AS effects,
             array_agg(each.key ORDER BY step.step, each.key) AS parameters,
             array_agg(each.value::float8 ORDER BY step.step, each.key) AS values
      FROM loopscope.explanation_step AS step
      CROSS JOIN LATERAL jsonb_each(step.parameters) AS each (key, value)
      WHERE step.loop_id = shown.loop_id AND step.slot_end = shown.slot_end
        AND step.algorithm_revision = shown.algorithm_revision
        AND step.input_revision = shown.input_revision
        AND CASE WHEN jsonb_typeof(each.value) = 'number'
                 THEN abs(each.value::numeric) < 1e300 END) AS fitted
    ORDER BY asked.id, shown.side, shown.number)"};

// What an outcome rested on may have been deleted since: it stays while the loop's work is the
// same.
const Statement kStoreRepairJudgement{"store_repair_judgement", R"(
    INSERT INTO loopscope.repair_judgement AS kept
      (maintenance_event_id, algorithm_revision, newest_slot_end, min_confidence, works, word,
       statement, windows_before, windows_after, fault_before, fault_after, variance_ratio,
       variance_ratio_low, variance_ratio_high, figures)
    SELECT work.maintenance_event_id, $2::integer, nullif($3, '')::timestamptz, $4::float8, $5,
           nullif($6, ''), $7, $8::integer, $9::integer, nullif($10, ''), nullif($11, ''),
           nullif($12, '')::float8, nullif($13, '')::float8, nullif($14, '')::float8, $15::jsonb
    FROM loopscope.maintenance_event AS work WHERE work.maintenance_event_id = $1::bigint
    ON CONFLICT (maintenance_event_id) DO UPDATE SET
      judged_at = now(), algorithm_revision = EXCLUDED.algorithm_revision,
      newest_slot_end = EXCLUDED.newest_slot_end, min_confidence = EXCLUDED.min_confidence,
      works = EXCLUDED.works,
      (word, statement, windows_before, windows_after, fault_before, fault_after,
       variance_ratio, variance_ratio_low, variance_ratio_high, figures) = (
        SELECT one.word, one.statement, one.windows_before, one.windows_after, one.fault_before,
               one.fault_after, one.variance_ratio, one.variance_ratio_low,
               one.variance_ratio_high, one.figures
        FROM (
          SELECT kept.word, kept.statement, kept.windows_before, kept.windows_after,
                 kept.fault_before, kept.fault_after, kept.variance_ratio,
                 kept.variance_ratio_low, kept.variance_ratio_high, kept.figures, true AS stays
          UNION ALL
          SELECT EXCLUDED.word, EXCLUDED.statement, EXCLUDED.windows_before,
                 EXCLUDED.windows_after, EXCLUDED.fault_before, EXCLUDED.fault_after,
                 EXCLUDED.variance_ratio, EXCLUDED.variance_ratio_low,
                 EXCLUDED.variance_ratio_high, EXCLUDED.figures, false) AS one
        WHERE one.stays = (kept.word IS NOT NULL AND EXCLUDED.word IS NULL
                           AND kept.works = EXCLUDED.works)))",
                                      Rows::none};

// A digest that no work has.
const Statement kMakeRepairsDue{"make_repairs_due", R"(
    UPDATE loopscope.repair_judgement SET works = '' FROM loopscope.maintenance_event AS work
    WHERE repair_judgement.maintenance_event_id = work.maintenance_event_id
      AND work.loop_id = ANY ($1::bigint[]))",
                                Rows::none};

using core::repair::Interval;
using core::repair::RepairWindow;

/// Of a verdict that only a later program knows: none.
std::string family_of(const std::string& code) {
  const auto known = core::diagnosis::verdict_code(code);
  return known ? std::string(core::diagnosis::catalogue_entry(*known).family) : std::string();
}

DueRepair read_due(const pqxx::row& row) {
  DueRepair due;
  due.maintenance_event_id = row["maintenance_event_id"].as<std::int64_t>();
  due.newest_slot_end_us = read_integer(row["newest_slot_end_us"]);
  due.works = read_text(row["works"]);
  due.windows.min_confidence = row["min_confidence"].as<double>();
  due.windows.refused = read_text(row["unusable_reason"]);
  if (!row["newest_code"].is_null())
    due.windows.newest = {family_of(row["newest_code"].c_str()),
                          row["newest_confidence"].as<double>(), read_text(row["newest_slot"])};
  return due;
}

std::vector<core::repair::EffectParameter> read_effects(const pqxx::row& row) {
  const std::vector<std::string> effects = read_text_list(row["effects"]);
  const std::vector<std::string> parameters = read_text_list(row["parameters"]);
  const auto values = read_number_list(row["values"]);
  std::vector<core::repair::EffectParameter> read;
  for (std::size_t k = 0; k < effects.size(); ++k)
    read.push_back({effects[k], parameters.at(k), values.at(k).value()});
  return read;
}

RepairWindow read_window(const pqxx::row& row) {
  RepairWindow window;
  window.code = row["code"].c_str();
  window.family = family_of(window.code);
  window.confidence = row["confidence"].as<double>();
  window.error_std = read_number(row["error_std"]);
  window.error_log_variance_se = read_number(row["error_log_variance_se"]);
  window.harris = read_number(row["harris"]);
  window.ngi = read_number(row["ngi"]);
  window.nli = read_number(row["nli"]);
  window.nonlinear_p = read_number(row["nonlinear_p"]);
  window.oscillating = row["oscillating"].as<bool>();
  window.oscillation_amplitude = read_number(row["oscillation_amplitude"]);
  window.valve_travel_per_h = read_number(row["valve_travel_per_h"]);
  window.controller_gain = read_number(row["controller_gain"]);
  window.integral_time_s = read_number(row["integral_time_s"]);
  window.effects = read_effects(row);
  return window;
}

std::vector<DueRepair> read_all_due(Transaction& transaction, std::int64_t behind,
                                    std::size_t limit) {
  std::vector<DueRepair> due;
  ArrayLiteral ids;
  std::map<std::int64_t, std::size_t> place;
  for (const pqxx::row& row :
       transaction.run(kDueRepairs, {std::to_string(core::kAlgorithmRevision),
                                     std::to_string(behind), std::to_string(limit)})) {
    due.push_back(read_due(row));
    ids.add_integer(due.back().maintenance_event_id);
    place[due.back().maintenance_event_id] = due.size() - 1;
  }
  if (due.empty()) return due;
  for (const pqxx::row& row : transaction.run(kRepairWindows, {ids.text()})) {
    core::repair::RepairWindows& windows =
        due.at(place.at(row["maintenance_event_id"].as<std::int64_t>())).windows;
    (std::string(row["side"].c_str()) == "before" ? windows.before : windows.after)
        .push_back(read_window(row));
  }
  return due;
}

std::string code_of(const std::optional<core::repair::StandingFault>& fault) {
  return fault ? fault->code : "";
}

std::vector<std::string> parameters_of(const JudgedRepair& judged) {
  const core::repair::RepairJudgement& judgement = judged.judgement;
  const auto variance = judgement.variance_ratio();
  const auto squared = [&](double Interval::*part) {
    return variance && std::isfinite((*variance).*part) ? number_text((*variance).*part) : "";
  };
  return {std::to_string(judged.repair.maintenance_event_id),
          std::to_string(core::kAlgorithmRevision),
          judged.repair.newest_slot_end_us ? timestamp_text(*judged.repair.newest_slot_end_us) : "",
          number_text(judged.repair.windows.min_confidence),
          judged.repair.works,
          judgement.outcome ? std::string(core::repair::name(*judgement.outcome)) : "",
          make_storable(judgement.statement),
          std::to_string(judgement.windows_before),
          std::to_string(judgement.windows_after),
          code_of(judgement.fault_before),
          code_of(judgement.fault_after),
          squared(&Interval::value),
          squared(&Interval::low),
          squared(&Interval::high),
          figures_json(judgement.figures)};
}

}  // namespace

struct RepairJudgements::Impl {
  explicit Impl(const ConnectionSettings& settings) : session(settings) {
    require_schema_version(session);
  }
  Session session;
};

RepairJudgements::RepairJudgements(const ConnectionSettings& settings)
    : impl_(std::make_unique<Impl>(settings)) {}
RepairJudgements::~RepairJudgements() = default;

std::vector<DueRepair> RepairJudgements::due(std::size_t limit, std::int64_t behind) {
  return impl_->session.transact(
      [&](Transaction& transaction) { return read_all_due(transaction, behind, limit); });
}

void RepairJudgements::make_due(std::span<const std::int64_t> loop_ids) {
  ArrayLiteral ids;
  for (const std::int64_t id : loop_ids) ids.add_integer(id);
  impl_->session.transact(
      [&](Transaction& transaction) { transaction.run(kMakeRepairsDue, {ids.text()}); });
}

void RepairJudgements::store(std::span<const JudgedRepair> judged) {
  impl_->session.transact([&](Transaction& transaction) {
    for (const JudgedRepair& repair : judged)
      transaction.run(kStoreRepairJudgement, parameters_of(repair));
  });
}

}  // namespace loopscope::storage
