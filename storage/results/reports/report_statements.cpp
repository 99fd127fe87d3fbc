#include "storage/results/reports/report_statements.hpp"

#include <string>

namespace loopscope::storage::statements {
namespace {

std::string us(const std::string& time) {
  return "(extract(epoch FROM " + time + ") * 1000000)::bigint";
}

/// Whether no window of a listed loop was judged before its fault was seen.
const std::string kOrEarlier =
    "listed.since <= (SELECT first.slot_end FROM loopscope.verdict AS first"
    " WHERE first.loop_id = listed.loop_id"
    " AND first.code NOT IN ('insufficient_data', 'not_controlling')"
    " ORDER BY first.slot_end LIMIT 1) AS or_earlier";

/// The columns of a FlaggedRow out of a row `listed` of flagged_loop.
std::string flagged_columns() {
  return R"((SELECT named.pv_unit FROM loopscope.loop AS named
             WHERE named.loop_id = listed.loop_id) AS pv_unit,
            rank, loop_id, loop_name, source, loop_type, area, unit, description, code, score, severity, importance,
            kind_weight, confidence, combined_confidence, fault_probability, p, nonlinear_p,
            status, )" +
         us("since") + " AS since_us, " + kOrEarlier + ", " + us("slot_end") +
         R"( AS slot_end_us, algorithm_revision,
            input_revision, analysis_id, summary, reasons, action, ngi, nli, oscillation_period_s,
            harris_low, harris_high, plant_oscillation_number )";
}

/// A row per figure of each repair; one with nulls where a repair has none.
std::string repairs_where(const std::string& condition) {
  return "SELECT repair.maintenance_event_id, repair.loop_id, repair.loop_name, " +
         us("repair.done_at") + R"( AS done_at_us, repair.kind, repair.description, repair.word,
           repair.statement, repair.code_before, repair.code_after, repair.windows_before,
           repair.windows_after, repair.author, repair.on_behalf_of, each.figure, said.unit, said.meaning, value.*
    FROM loopscope.before_after_maintenance AS repair
    LEFT JOIN LATERAL jsonb_each(repair.figures) AS each (figure, object) ON true
    LEFT JOIN LATERAL jsonb_to_record(each.object) AS value (
      before float8, before_low float8, before_high float8, after float8, after_low float8,
      after_high float8, is_ratio boolean, change float8, change_low float8, change_high float8)
      ON true
    LEFT JOIN (SELECT DISTINCT figure, unit, meaning FROM loopscope.figure_kind) AS said
      ON said.figure = each.figure
    WHERE )" +
         condition + " ORDER BY repair.done_at DESC, repair.maintenance_event_id DESC, each.figure";
}

}  // namespace

const Statement kReportNow{"report_now", "SELECT " + us("now()") + " AS now_us", Rows::one};

const Statement kSmallLetters{"small_letters", "SELECT lower($1::text) AS text", Rows::one};

const Statement kReportCounts{"report_counts", R"(
    WITH newest AS MATERIALIZED (SELECT code FROM loopscope.own_verdict WHERE enabled),
    catalogue AS (SELECT count(*) AS loops, count(*) FILTER (WHERE enabled) AS enabled
                  FROM loopscope.loop)
    SELECT loops, enabled,
           (SELECT count(*) FROM newest
            WHERE code NOT IN ('insufficient_data', 'not_controlling')) AS judged,
           (SELECT count(*) FROM newest WHERE code = 'insufficient_data') AS unjudgeable,
           (SELECT count(*) FROM newest WHERE code = 'not_controlling') AS not_controlling,
           (SELECT avg(week_fraction) FROM loopscope.service_factor)::float8 AS service_factor,
           enabled - (SELECT count(*) FROM newest) AS never_analysed,
           (SELECT count(DISTINCT (loop_id, job.begins_at))
            FROM loopscope.before_after_maintenance AS repair
            JOIN loopscope.maintenance_job AS job USING (maintenance_event_id, loop_id)
            WHERE repair.done_at > $1::timestamptz AND repair.word = 'fixed') AS fixed,
           )" + us("now()") + R"( AS now_us
    FROM catalogue)",
                              Rows::one};

// Of each loop the problem of a tag where there is one, else what the analysis says, its figures
// left out so that loops with the same trouble are counted together.
const Statement kUnjudgedReasons{"unjudged_reasons", R"(
    SELECT words, remedy, count(*) AS loops,
           (array_agg(loop_name ORDER BY loop_name))[:20] AS names
    FROM (
      SELECT DISTINCT ON (loop_id) loop_name,
             regexp_replace(words, '[0-9]+([.][0-9]+)?( %)?', '...', 'g') AS words, remedy
      FROM loopscope.data_problem
      WHERE NOT judged AND loop_id IN (
        SELECT loop_id FROM loopscope.own_verdict WHERE code = 'insufficient_data')
      ORDER BY loop_id, array_position(
        ARRAY['no_rows', 'dead_tag', 'bad_quality', 'unknown_quality', 'insufficient_data'], problem),
        role = 'pv' DESC, words) AS one
    GROUP BY words, remedy
    ORDER BY loops DESC, words)"};

const Statement kNotControlling{"not_controlling", R"(
    SELECT loop_id, loop_name, area, coalesce(lost_by, '') AS lost_by, )" +
                                                       us("lost_since") +
                                                       R"( AS since_us, week_fraction
    FROM loopscope.service_factor WHERE NOT controlling ORDER BY area NULLS LAST, loop_name)"};

const Statement kReportFlagged{
    "report_flagged",
    "SELECT " + flagged_columns() + "FROM loopscope.flagged_loop AS listed ORDER BY rank"};

const Statement kReportLatest{"report_latest", "SELECT " + flagged_columns() + R"(
    FROM (
      SELECT 0::bigint AS rank, latest.*, coalesce(kind.weight, 0) AS kind_weight,
             CASE WHEN latest.harris_low IS NULL OR latest.harris_high IS NULL THEN 0.5
                  ELSE least(greatest(1 - (latest.harris_low + latest.harris_high) / 2, 0), 1)
             END AS severity,
             0::float8 AS score, CASE WHEN run.confirmed THEN 'confirmed' ELSE 'watch' END AS status,
             coalesce(run.since, latest.slot_end) AS since,
             (SELECT min(number) FROM loopscope.current_plant_oscillation
              WHERE source_loop_id = latest.loop_id AND latest.slot_end <= holds_until
                AND kind.is_fault) AS plant_oscillation_number
      FROM loopscope.own_verdict AS latest
      JOIN loopscope.verdict_kind AS kind ON kind.code = latest.code
      LEFT JOIN LATERAL loopscope.verdict_run(latest.loop_id, latest.slot_end, latest.code) AS run
        ON true
      WHERE latest.loop_name = $1) AS listed)"};

const Statement kReportHistory{"report_history", "SELECT DISTINCT ON (given.slot_end) " +
                                                     us("given.slot_end") + R"( AS slot_end_us,
           given.code, given.confidence, measured.ngi, measured.nli, measured.nonlinear_p,
           measured.error_std, measured.harris_low, measured.harris_high,
           measured.oscillation_period_s
    FROM loopscope.verdict AS given
    LEFT JOIN loopscope.analysis AS measured
      USING (loop_id, slot_end, algorithm_revision, input_revision)
    WHERE given.loop_id = $1::bigint AND given.slot_end >= $2::timestamptz
    ORDER BY given.slot_end, given.algorithm_revision DESC, given.input_revision DESC)"};

const Statement kReportRepairs{"report_repairs",
                               repairs_where("repair.done_at >= $1::timestamptz")};

const Statement kRepairsOfLoop{"repairs_of_loop", repairs_where("repair.loop_id = $1::bigint")};

const Statement kHiddenLoops{"hidden_loops", R"(
    SELECT loop_id, loop_name, code, hidden_by, reason, author, )" +
                                                 us("entered_at") + " AS entered_us, " +
                                                 us("until") +
                                                 R"( AS until_us, annotation_id,
           plant_oscillation_number, source_loop_name, on_behalf_of
    FROM loopscope.hidden_loop ORDER BY loop_id, plant_oscillation_number NULLS LAST, entered_at)"};

// Without a remedy it is nobody's to repair: a figure of the signal, which the section tells below.
const Statement kLoopProblems{"loop_problems", R"(
    SELECT problem, role, tag, words, remedy, )" + us("since") +
                                                   R"( AS since_us, judged
    FROM loopscope.data_problem
    WHERE loop_id = $1::bigint AND remedy <> ''
    ORDER BY judged, since, problem)"};

const Statement kWhatIf{"what_if", R"(
    WITH present AS MATERIALIZED (SELECT * FROM loopscope.flagged_loop),
    other AS MATERIALIZED (
      SELECT * FROM loopscope.flagged_at(
        nullif($1, '')::float8, nullif($2, '')::float8, nullif($3, '')::float8))
    SELECT change, )" + flagged_columns() +
                                       R"(
    FROM (
      SELECT CASE WHEN present.loop_id IS NULL THEN 'gained' ELSE 'kept' END AS change, other.*
      FROM other LEFT JOIN present USING (loop_id)
      UNION ALL
      SELECT 'lost', present.* FROM present
      WHERE loop_id NOT IN (SELECT loop_id FROM other)) AS listed
    ORDER BY change = 'lost', rank)"};

}  // namespace loopscope::storage::statements
