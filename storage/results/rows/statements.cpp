#include "storage/results/rows/statements.hpp"

#include "storage/results/rows/loop_columns.hpp"

namespace loopscope::storage::statements {

const Statement kStoredDigests{"stored_digests", R"(
    SELECT wanted.loop_id, (extract(epoch FROM wanted.slot_end) * 1000000)::bigint AS slot_end_us,
           analysis.input_digest, analysis.usable, analysis.same_settings,
           analysis.modelled
    FROM unnest($1::bigint[], $2::timestamptz[]) AS wanted (loop_id, slot_end)
    CROSS JOIN LATERAL (
      SELECT stored.input_digest, stored.settings = $4::jsonb AS same_settings,
             stored.model IS NOT NULL AS modelled,
             stored.usable OR 'pv_frozen' = ANY (stored.flags) AS usable
      FROM loopscope.analysis AS stored
      WHERE stored.loop_id = wanted.loop_id AND stored.slot_end = wanted.slot_end
        AND stored.algorithm_revision = $3::integer
      LIMIT 1) AS analysis)"};

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
                                Rows::none};

const Statement kInsertPeaks{"insert_peaks", R"(
    INSERT INTO loopscope.bicoherence_peak (loop_id, slot_end, algorithm_revision, input_revision,
                                            rank, f1, f2, bic2, p)
    SELECT * FROM unnest($1::bigint[], $2::timestamptz[], $3::integer[], $4::integer[],
                         $5::integer[], $6::float8[], $7::float8[], $8::float8[], $9::float8[]))",
                             Rows::none};

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
                             Rows::none};

// A problem that stood at the loop's slot before goes on; one that was away begins anew. One that
// was last seen after now(), under a clock ahead, goes on if it began before.
const Statement kNoteProblems{"note_problems", R"(
    INSERT INTO loopscope.standing_problem AS kept
      (loop_id, code, role, first_slot, last_slot, previous_slot, slots, last_row, figure)
    SELECT loop_id, code, role, slot, slot, previous_slot, 1, last_row, figure
    FROM unnest($1::bigint[], $2::text[], $3::text[], $4::timestamptz[], $5::timestamptz[],
                $6::timestamptz[], $7::float8[])
      AS found (loop_id, code, role, slot, previous_slot, last_row, figure)
    ON CONFLICT (loop_id, code, role) DO UPDATE SET
      first_slot = CASE WHEN kept.last_slot IN (EXCLUDED.last_slot, EXCLUDED.previous_slot)
                          OR kept.last_slot > now() AND kept.first_slot <= EXCLUDED.last_slot
                        THEN kept.first_slot ELSE EXCLUDED.first_slot END,
      slots = CASE WHEN kept.last_slot = EXCLUDED.last_slot THEN kept.slots
                   WHEN kept.last_slot = EXCLUDED.previous_slot THEN kept.slots + 1
                   WHEN kept.last_slot > now() AND kept.first_slot <= EXCLUDED.last_slot
                   THEN kept.slots ELSE 1 END,
      last_slot = EXCLUDED.last_slot, previous_slot = EXCLUDED.previous_slot,
      last_row = EXCLUDED.last_row, figure = EXCLUDED.figure
    WHERE kept.last_slot <= EXCLUDED.last_slot OR kept.last_slot > now())",
                              Rows::none};

const Statement kAddStageCost{"add_stage_cost", R"(
    INSERT INTO loopscope.stage_cost AS kept
      (hour, host, lane, loops, analysed, modelled, sample_values, claim_s, fetch_s, prepare_s,
       statistics_s, model_s, decide_s, write_s, wait_s)
    VALUES (date_trunc('hour', now()), $1, $2::integer, $3::bigint, $4::bigint, $5::bigint,
            $6::bigint, $7::float8, $8::float8, $9::float8, $10::float8, $11::float8, $12::float8,
            $13::float8, $14::float8)
    ON CONFLICT (hour, host, lane) DO UPDATE SET
      loops = kept.loops + EXCLUDED.loops, analysed = kept.analysed + EXCLUDED.analysed,
      modelled = kept.modelled + EXCLUDED.modelled,
      sample_values = kept.sample_values + EXCLUDED.sample_values,
      claim_s = kept.claim_s + EXCLUDED.claim_s, fetch_s = kept.fetch_s + EXCLUDED.fetch_s,
      prepare_s = kept.prepare_s + EXCLUDED.prepare_s,
      statistics_s = kept.statistics_s + EXCLUDED.statistics_s,
      model_s = kept.model_s + EXCLUDED.model_s, decide_s = kept.decide_s + EXCLUDED.decide_s,
      write_s = kept.write_s + EXCLUDED.write_s, wait_s = kept.wait_s + EXCLUDED.wait_s)",
                              Rows::none};

// A value that stands already is not written again: every new connection sets some, and would wait
// for whoever holds their rows.
const Statement kSetParameter{"set_parameter", R"(
    WITH changed AS (
      UPDATE loopscope.parameter SET value = $2::float8 WHERE name = $1 AND value <> $2::float8)
    SELECT name FROM loopscope.parameter WHERE name = $1)"};

const Statement kListLoops{"list_loops",
                           "SELECT " LOOPSCOPE_LOOP_COLUMNS " FROM loopscope.loop ORDER BY name"};

const Statement kFindLoop{"find_loop",
                          "SELECT " LOOPSCOPE_LOOP_COLUMNS " FROM loopscope.loop WHERE name = $1"};

// xmax is 0 in a row that was inserted and the updating transaction in one that was there before.
const Statement kSaveLoops{"save_loops", R"(
    INSERT INTO loopscope.loop AS kept (name, source, sp_tag, pv_tag, op_tag, mv_tag, mode_tag,
                                        interval_s, period_s, op_low, op_high, loop_type,
                                        importance, enabled, area, unit, description, pv_unit,
                                        owner, pv_low, pv_high)
    SELECT name, source, nullif(sp_tag, ''), pv_tag, nullif(op_tag, ''), nullif(mv_tag, ''),
           nullif(mode_tag, ''), interval_s, period_s, op_low, op_high, nullif(loop_type, ''),
           importance, enabled, nullif(area, ''), nullif(unit, ''), nullif(description, ''),
           nullif(pv_unit, ''), nullif(owner, ''), pv_low, pv_high
    FROM unnest($1::text[], $2::text[], $3::text[], $4::text[], $5::text[], $6::text[], $7::text[],
                $8::float8[], $9::float8[], $10::float8[], $11::float8[], $12::text[],
                $13::float8[], $14::boolean[], $15::text[], $16::text[], $17::text[], $18::text[],
                $19::text[], $20::float8[], $21::float8[])
      AS entry (name, source, sp_tag, pv_tag, op_tag, mv_tag, mode_tag, interval_s, period_s,
                op_low, op_high, loop_type, importance, enabled, area, unit, description, pv_unit,
                owner, pv_low, pv_high)
    ON CONFLICT (name) DO UPDATE SET
      source = EXCLUDED.source, sp_tag = EXCLUDED.sp_tag, pv_tag = EXCLUDED.pv_tag,
      op_tag = EXCLUDED.op_tag, mv_tag = EXCLUDED.mv_tag, mode_tag = EXCLUDED.mode_tag,
      interval_s = EXCLUDED.interval_s, period_s = EXCLUDED.period_s, op_low = EXCLUDED.op_low,
      op_high = EXCLUDED.op_high, loop_type = EXCLUDED.loop_type,
      importance = EXCLUDED.importance, enabled = EXCLUDED.enabled, area = EXCLUDED.area,
      unit = EXCLUDED.unit, description = EXCLUDED.description, pv_unit = EXCLUDED.pv_unit,
      owner = EXCLUDED.owner, pv_low = EXCLUDED.pv_low, pv_high = EXCLUDED.pv_high,
      changed_at = now()
    RETURNING kept.loop_id, kept.xmax = 0 AS is_new)"};

const Statement kSetEnabled{"set_enabled", R"(
    UPDATE loopscope.loop SET enabled = $2::boolean, changed_at = now()
    WHERE name = ANY ($1::text[]) RETURNING loop_id)"};

const Statement kRefuseMaintenance{"refuse_maintenance", R"(
    SELECT place, CASE WHEN loop.loop_id IS NULL THEN 'unknown_loop'
                       WHEN entry.done_at > now() THEN 'in_future'
                       ELSE 'entered_already' END AS reason
    FROM (SELECT *, row_number() OVER (PARTITION BY loop_name, done_at, description ORDER BY place)
                      AS times
          FROM unnest($1::text[], $2::timestamptz[], $3::text[], $4::text[])
            WITH ORDINALITY AS given (loop_name, done_at, kind, description, place)) AS entry
    LEFT JOIN loopscope.loop ON loop.name = entry.loop_name
    WHERE loop.loop_id IS NULL OR entry.done_at > now() OR times > 1
       OR EXISTS (SELECT FROM loopscope.maintenance_event AS known
                  WHERE known.loop_id = loop.loop_id AND known.done_at = entry.done_at
                    AND known.description = entry.description)
    ORDER BY place)"};

const Statement kAddMaintenance{"add_maintenance", R"(
    INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description)
    SELECT loop.loop_id, entry.done_at, entry.kind, entry.description
    FROM unnest($1::text[], $2::timestamptz[], $3::text[], $4::text[])
      AS entry (loop_name, done_at, kind, description)
    JOIN loopscope.loop ON loop.name = entry.loop_name)",
                                Rows::none};

const Statement kListMaintenance{"list_maintenance", R"(
    SELECT maintenance_event_id, loop_name, (extract(epoch FROM done_at) * 1000000)::bigint
             AS done_at_us, kind, description, word, statement
    FROM loopscope.before_after_maintenance
    WHERE NOT $1::boolean OR loop_id IN (SELECT loop_id FROM loopscope.loop
                                         WHERE name = ANY ($2::text[]))
    ORDER BY loop_name, done_at, maintenance_event_id)"};

}  // namespace loopscope::storage::statements
