-- Several windows of a loop make one verdict, and the list goes by how probable a fault is.

ALTER TABLE loopscope.verdict ADD COLUMN cause_evidence real[];
COMMENT ON COLUMN loopscope.verdict.cause_evidence IS 'Log odds of each cause beyond its prior, in the order of cause_probabilities; null = nothing was weighed, or a program before schema 22';
ALTER TABLE loopscope.analysis ADD COLUMN combined_probabilities real[], ADD COLUMN combined_evidence real[], ADD COLUMN combined_windows real[];
COMMENT ON COLUMN loopscope.analysis.combined_probabilities IS 'Probability of each cause by this window and those before it, in the order of verdict.cause_probabilities; follows from the stored rows (core/diagnosis/combined_odds); null = the window could not be judged, or a program before schema 22';
COMMENT ON COLUMN loopscope.analysis.combined_evidence IS 'Weighted mean of the log odds of each cause beyond its prior, of this window and those before it';
COMMENT ON COLUMN loopscope.analysis.combined_windows IS 'For each cause, as many windows that share no sample would weigh as much: new samples count, old windows are forgotten';

INSERT INTO loopscope.parameter (name, value, unit, description) VALUES
  ('list_false_share', 0.02, 'share, 0 to 1', 'Expected share of loops without a fault among those on the list: the mean of 1 - fault_probability');

-- A partition's columns have comments of their own.
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT part.inhrelid::regclass AS name, own.attname, col_description(part.inhparent, whole.attnum) AS words
    FROM pg_inherits AS part
    JOIN pg_attribute AS own ON own.attrelid = part.inhrelid AND own.attnum > 0 AND NOT own.attisdropped
    JOIN pg_attribute AS whole ON whole.attrelid = part.inhparent AND whole.attname = own.attname
    WHERE part.inhparent IN ('loopscope.analysis'::regclass, 'loopscope.verdict'::regclass)
      AND col_description(part.inhrelid, own.attnum) IS DISTINCT FROM col_description(part.inhparent, whole.attnum)
  LOOP
    EXECUTE format('COMMENT ON COLUMN %s.%I IS %L', missing.name, missing.attname, missing.words);
  END LOOP;
END $$;

CREATE OR REPLACE VIEW loopscope.latest_verdict AS
  SELECT loop.loop_id, loop.name AS loop_name, loop.source, loop.loop_type, loop.importance, loop.enabled,
         verdict.slot_end, verdict.algorithm_revision, verdict.input_revision, verdict.analysis_id,
         verdict.code, verdict.confidence, verdict.p,
         verdict.summary, verdict.reasons, verdict.action, verdict.decided_at,
         analysis.window_start, analysis.window_end, analysis.usable, analysis.flags,
         analysis.ngi, analysis.nli, analysis.nonlinear_p, analysis.coupling,
         analysis.oscillating, analysis.oscillation_period_s, analysis.oscillation_p,
         analysis.harris_low, analysis.harris_high, analysis.harris_p, analysis.error_std,
         analysis.model_excited,
         verdict.cause_probabilities, analysis.combined_probabilities,
         analysis.combined_probabilities[array_position(
           '{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,nonlinear_unexplained}'::text[],
           verdict.code)]::double precision AS combined_confidence,
         1 - coalesce(analysis.combined_probabilities[1], verdict.cause_probabilities[1])::double precision AS fault_probability
  FROM loopscope.loop
  JOIN loopscope.schedule USING (loop_id)
  CROSS JOIN LATERAL (
    SELECT * FROM loopscope.verdict AS candidate
    WHERE candidate.loop_id = schedule.loop_id AND candidate.slot_end = schedule.result_slot_end
    ORDER BY candidate.algorithm_revision DESC, candidate.input_revision DESC
    LIMIT 1) AS verdict
  CROSS JOIN LATERAL (
    SELECT * FROM loopscope.analysis AS measured
    WHERE measured.loop_id = verdict.loop_id AND measured.slot_end = verdict.slot_end
      AND measured.algorithm_revision = verdict.algorithm_revision
    LIMIT 1) AS analysis;
COMMENT ON COLUMN loopscope.latest_verdict.cause_probabilities IS 'Probability of each cause by the newest window alone (verdict_cause has a row for each)';
COMMENT ON COLUMN loopscope.latest_verdict.combined_probabilities IS 'The same by this window and those before it';
COMMENT ON COLUMN loopscope.latest_verdict.combined_confidence IS 'Probability of the code by this window and those before it; null = the code is no cause, or was judged by a program before schema 22';
COMMENT ON COLUMN loopscope.latest_verdict.fault_probability IS '1 less the probability of healthy, by all windows where they were combined; null = nothing was weighed';

-- The list, at any thresholds. It asks two things. Whether a fault is probable: loops in the order of how probable one is, as long
-- as the mean of what is left to doubt stays below the share (Newton et al. 2004). And the control of 0006, whether evidence as strong
-- is rare among loops without that fault; at a rate of 1 odds alone decide. core/plant/README.md says why both. A verdict without
-- probabilities (a program of before, a loop that is not in command) is asked the second alone. What hides a verdict hides it before.
CREATE FUNCTION loopscope.flagged_by_odds(rate float8 DEFAULT NULL, dependence float8 DEFAULT NULL, least_confidence float8 DEFAULT NULL)
RETURNS TABLE (
  rank bigint, loop_id bigint, loop_name text, source text, loop_type text, code text, score float8, severity float8,
  importance float8, kind_weight float8, confidence float8, p float8, false_discovery_threshold float8, nonlinear_p float8,
  slot_end timestamptz, algorithm_revision integer, input_revision integer, analysis_id bigint, summary text, reasons text[],
  action text, ngi float8, nli float8, oscillation_period_s float8, harris_low float8, harris_high float8,
  status text, since timestamptz, plant_oscillation_number integer,
  combined_confidence float8, fault_probability float8) LANGUAGE sql STABLE
BEGIN ATOMIC
  WITH setting AS (
    SELECT coalesce(rate, max(value) FILTER (WHERE name = 'false_discovery_rate')) AS false_discovery_rate,
           max(value) FILTER (WHERE name = 'list_false_share') AS list_false_share,
           coalesce(dependence, max(value) FILTER (WHERE name = 'false_discovery_dependence')) AS false_discovery_dependence,
           coalesce(least_confidence, max(value) FILTER (WHERE name = 'min_confidence')) AS min_confidence
    FROM loopscope.parameter
  ), held AS (
    SELECT loop_id, array_agg(code) AS codes, bool_or(code IS NULL AND last_slot IS NULL) AS whatever_the_code, max(last_slot) AS last_slot
    FROM loopscope.hiding GROUP BY loop_id
  ), latest AS MATERIALIZED (
    SELECT latest_verdict.*, kind.weight AS kind_weight,
           -- A verdict that rests on a test belongs to the family even if its analysis shows none.
           -- A model that may claim something makes two: of the next effect, and of what is left.
           greatest(CASE WHEN usable THEN num_nonnulls(nonlinear_p, oscillation_p, harris_p) + CASE WHEN model_excited THEN 2 ELSE 0 END
                         ELSE 0 END, num_nonnulls(p)) AS tests,
           kind.is_fault AND coalesce(combined_confidence, confidence) >= setting.min_confidence AND NOT coalesce(held.whatever_the_code
             OR latest_verdict.code = ANY (held.codes) OR latest_verdict.slot_end <= held.last_slot, false) AS shown
    FROM loopscope.latest_verdict JOIN loopscope.verdict_kind AS kind USING (code)
    LEFT JOIN held USING (loop_id) CROSS JOIN setting
    WHERE enabled
  ), scale AS MATERIALIZED (  -- once, not for every loop
    SELECT m * CASE WHEN false_discovery_dependence > 0
                    THEN (SELECT sum(1 / i::double precision) FROM generate_series(1, m) AS i) ELSE 1 END AS scaled_m
    FROM (SELECT sum(tests) AS m FROM latest) AS family CROSS JOIN setting
  ), ranked AS (SELECT p, row_number() OVER (ORDER BY p) AS i FROM latest WHERE shown AND p IS NOT NULL
  ), control AS (
    SELECT max(ranked.p) AS threshold FROM ranked CROSS JOIN scale CROSS JOIN setting
    WHERE ranked.p <= setting.false_discovery_rate * ranked.i / scale.scaled_m
  ), listed AS (  -- those of one probability come together or not at all; what is more likely no fault than one is not listed
    SELECT loop_id, doubt <= setting.list_false_share AND fault_probability >= 0.5 AS within_share
    FROM (SELECT loop_id, fault_probability, avg(1 - fault_probability) OVER (ORDER BY fault_probability DESC) AS doubt
          FROM latest WHERE shown AND fault_probability IS NOT NULL) AS ordered CROSS JOIN setting
  ), candidate AS (
    SELECT latest.*,
           -- What a perfect linear controller could win; the middle where the index is unknown.
           CASE WHEN harris_low IS NULL OR harris_high IS NULL THEN 0.5
                ELSE least(greatest(1 - (harris_low + harris_high) / 2, 0), 1) END AS severity,
           control.threshold AS false_discovery_threshold
    FROM latest LEFT JOIN listed USING (loop_id) CROSS JOIN control CROSS JOIN setting
    WHERE shown AND coalesce(listed.within_share, true) AND (p IS NULL OR p <= control.threshold OR setting.false_discovery_rate >= 1)
  ), caused AS (
    SELECT source_loop_id, min(number) AS number, max(holds_until) AS holds_until
    FROM loopscope.current_plant_oscillation GROUP BY source_loop_id
  )
  SELECT row_number() OVER (ORDER BY severity * importance * kind_weight * coalesce(combined_confidence, confidence) DESC,
                            candidate.loop_id) AS rank,
         candidate.loop_id, loop_name, source, loop_type, code,
         severity * importance * kind_weight * coalesce(combined_confidence, confidence) AS score,
         severity, importance, kind_weight, confidence, p, false_discovery_threshold, nonlinear_p,
         slot_end, algorithm_revision, input_revision, analysis_id, summary, reasons, action,
         ngi, nli, oscillation_period_s, harris_low, harris_high,
         CASE WHEN run.confirmed THEN 'confirmed' ELSE 'watch' END AS status, run.since, caused.number AS plant_oscillation_number,
         combined_confidence, fault_probability
  FROM candidate
  CROSS JOIN LATERAL loopscope.verdict_run(candidate.loop_id, candidate.slot_end, candidate.code) AS run
  LEFT JOIN caused ON caused.source_loop_id = candidate.loop_id AND candidate.slot_end <= caused.holds_until
  ORDER BY rank;
END;
-- Views of a site's own, and rights of persons, stay: the view keeps its columns, the function its name.
CREATE OR REPLACE VIEW loopscope.flagged_loop AS SELECT * FROM loopscope.flagged_by_odds();
DROP FUNCTION loopscope.flagged_at(double precision, double precision, double precision);
ALTER FUNCTION loopscope.flagged_by_odds RENAME TO flagged_at;
COMMENT ON FUNCTION loopscope.flagged_at(double precision, double precision, double precision) IS 'flagged_loop as it would be at other thresholds: false_discovery_rate, false_discovery_dependence, min_confidence; null = as they are set';

COMMENT ON VIEW loopscope.flagged_loop IS 'Loops that somebody should act on, worst first: faults of enabled loops, as many of the most probable ones as keep the expected share of loops without a fault below list_false_share, that are facts or pass the false-discovery control, and neither annotated away nor victims of a shared oscillation';
COMMENT ON COLUMN loopscope.flagged_loop.status IS 'watch = new; confirmed = the same verdict came in a second window that shares no sample with the first one of its run';
COMMENT ON COLUMN loopscope.flagged_loop.since IS 'Slot of the first verdict of the unbroken run of this code';
COMMENT ON COLUMN loopscope.flagged_loop.plant_oscillation_number IS 'Shared oscillation (current_plant_oscillation) that the loop is the source of; null = none';
COMMENT ON COLUMN loopscope.flagged_loop.rank IS '1 = act here first';
COMMENT ON COLUMN loopscope.flagged_loop.score IS 'severity x importance x kind_weight x combined_confidence (confidence where there is none)';
COMMENT ON COLUMN loopscope.flagged_loop.severity IS '1 minus the middle of the Harris index, 0 to 1; 0.5 where that is unknown';
COMMENT ON COLUMN loopscope.flagged_loop.kind_weight IS 'Weight of the kind of fault (parameter weight_...)';
COMMENT ON COLUMN loopscope.flagged_loop.false_discovery_threshold IS 'Largest p that is flagged today; null = none is, only facts';

-- As in 0014: a column that is named like an older one means the same.
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT DISTINCT ON (class.oid, shown.attnum) class.relname, shown.attname, col_description(source.attrelid, source.attnum) AS words
    FROM pg_class AS class
    JOIN pg_attribute AS shown ON shown.attrelid = class.oid AND shown.attnum > 0
    JOIN unnest('{analysis,verdict,loop,latest_verdict}'::text[]) WITH ORDINALITY AS origin (name, priority) ON true
    JOIN pg_attribute AS source ON source.attrelid = format('loopscope.%I', origin.name)::regclass AND source.attname = shown.attname
     AND col_description(source.attrelid, source.attnum) IS NOT NULL
    WHERE class.oid = 'loopscope.flagged_loop'::regclass AND col_description(class.oid, shown.attnum) IS NULL
    ORDER BY class.oid, shown.attnum, origin.priority
  LOOP
    EXECUTE format('COMMENT ON COLUMN loopscope.%I.%I IS %L', missing.relname, missing.attname, missing.words);
  END LOOP;
END $$;
