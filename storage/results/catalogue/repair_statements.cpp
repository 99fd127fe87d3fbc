#include "storage/results/catalogue/repair_statements.hpp"

namespace loopscope::storage::statements {

const Statement kDueRepairs{"due_repairs", R"(
    WITH setting AS (
      SELECT coalesce(max(value), 0) AS min_confidence
      FROM loopscope.parameter WHERE name = 'min_confidence'
    ), due AS MATERIALIZED (
      SELECT work.maintenance_event_id, work.loop_id, schedule.result_slot_end
      FROM loopscope.maintenance_event AS work
      JOIN loopscope.schedule USING (loop_id)
      CROSS JOIN setting
      LEFT JOIN loopscope.repair_judgement AS known USING (maintenance_event_id)
      WHERE known.maintenance_event_id IS NULL
         OR (work.done_at > now() - interval '1 year'
             AND (known.newest_slot_end IS DISTINCT FROM schedule.result_slot_end
                  OR known.algorithm_revision < $1::integer
                  OR known.min_confidence <> setting.min_confidence
                  OR EXISTS (SELECT FROM loopscope.maintenance_event AS other
                             WHERE other.loop_id = work.loop_id
                               AND other.entered_at > known.judged_at)))
      ORDER BY work.maintenance_event_id
      LIMIT $2::bigint
    )
    SELECT due.maintenance_event_id, setting.min_confidence,
           (extract(epoch FROM due.result_slot_end) * 1000000)::bigint AS newest_slot_end_us,
           refused.unusable_reason, newest.code AS newest_code,
           newest.confidence AS newest_confidence,
           to_char(newest.slot_end AT TIME ZONE 'UTC', 'YYYY-MM-DD HH24:MI') AS newest_slot
    FROM due
    CROSS JOIN setting
    CROSS JOIN LATERAL (
      SELECT * FROM loopscope.maintenance_job AS own
      WHERE own.maintenance_event_id = due.maintenance_event_id) AS job
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

const Statement kRepairWindows{"repair_windows", R"(
    SELECT asked.id AS maintenance_event_id, shown.side, shown.code, shown.confidence,
           shown.error_std, shown.error_log_variance_se, shown.harris, shown.ngi, shown.nli,
           shown.nonlinear_p, coalesce(shown.oscillating, false) AS oscillating,
           shown.oscillation_amplitude, shown.valve_travel_per_h, shown.controller_gain,
           shown.integral_time_s, fitted.effects, fitted.parameters, fitted.values
    FROM unnest($1::bigint[]) AS asked (id)
    CROSS JOIN LATERAL (
      SELECT * FROM loopscope.maintenance_window AS near
      WHERE near.maintenance_event_id = asked.id) AS shown
    CROSS JOIN LATERAL (
      SELECT array_agg(step.effect ORDER BY step.step, each.key) AS effects,
             array_agg(each.key ORDER BY step.step, each.key) AS parameters,
             array_agg(each.value::float8 ORDER BY step.step, each.key) AS values
      FROM loopscope.explanation_step AS step
      CROSS JOIN LATERAL jsonb_each(step.parameters) AS each (key, value)
      WHERE step.loop_id = shown.loop_id AND step.slot_end = shown.slot_end
        AND step.algorithm_revision = shown.algorithm_revision
        AND step.input_revision = shown.input_revision
        AND jsonb_typeof(each.value) = 'number') AS fitted
    ORDER BY asked.id, shown.side, shown.number)"};

// What an outcome rested on may have been deleted since: it stays, unless other work was entered.
const Statement kStoreRepairJudgement{"store_repair_judgement", R"(
    INSERT INTO loopscope.repair_judgement AS kept
      (maintenance_event_id, algorithm_revision, newest_slot_end, min_confidence, word, statement,
       windows_before, windows_after, fault_before, fault_after, variance_ratio,
       variance_ratio_low, variance_ratio_high, figures)
    SELECT work.maintenance_event_id, $2::integer, nullif($3, '')::timestamptz, $4::float8,
           nullif($5, ''), $6, $7::integer, $8::integer, nullif($9, ''), nullif($10, ''),
           nullif($11, '')::float8, nullif($12, '')::float8, nullif($13, '')::float8, $14::jsonb
    FROM loopscope.maintenance_event AS work WHERE work.maintenance_event_id = $1::bigint
    ON CONFLICT (maintenance_event_id) DO UPDATE SET
      judged_at = now(), algorithm_revision = EXCLUDED.algorithm_revision,
      newest_slot_end = EXCLUDED.newest_slot_end, min_confidence = EXCLUDED.min_confidence,
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
        WHERE one.stays = (
          kept.word IS NOT NULL AND EXCLUDED.word IS NULL AND NOT EXISTS (
            SELECT FROM loopscope.maintenance_event AS other
            JOIN loopscope.maintenance_event AS own USING (loop_id)
            WHERE own.maintenance_event_id = kept.maintenance_event_id
              AND other.entered_at > kept.judged_at))))",
                                      Rows::none};

}  // namespace loopscope::storage::statements
