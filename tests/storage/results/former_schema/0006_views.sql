-- What people read. Each view says in its comment what one row is.

CREATE VIEW loopscope.verdict_kind (code, is_fault, weight, meaning) AS
  SELECT kind.code, kind.is_fault, parameter.value, kind.meaning
  FROM (VALUES
    ('healthy', false, 'Nothing is left to explain'),
    ('valve_stiction', true, 'The valve sticks and jumps'),
    ('valve_deadband', true, 'The valve has play (backlash)'),
    ('valve_saturation', true, 'The valve runs into a limit'),
    ('valve_characteristic', true, 'The valve''s characteristic is bent: wear, corroded seat, wrong trim'),
    ('valve_oversized', true, 'Tiny movements of the valve move the process a lot'),
    ('process_nonlinearity', true, 'The process itself is nonlinear'),
    ('external_disturbance', true, 'Something outside the loop disturbs it'),
    ('process_change', true, 'The process gain changed'),
    ('sensor_fault', true, 'The measurement is coarse or held'),
    ('tight_tuning', true, 'The controller is tuned too tightly'),
    ('sluggish_tuning', true, 'The controller is tuned too slowly'),
    ('nonlinear_unexplained', true, 'Nonlinear, but no known effect explains it'),
    ('unexplained', true, 'Structured, but no known effect explains it'),
    ('insufficient_data', false, 'The data cannot be judged')
  ) AS kind (code, is_fault, meaning)
  LEFT JOIN loopscope.parameter ON parameter.name = 'weight_' || kind.code;
COMMENT ON VIEW loopscope.verdict_kind IS 'Every verdict: what it means and how it counts';
COMMENT ON COLUMN loopscope.verdict_kind.is_fault IS 'Whether somebody should act on it';
COMMENT ON COLUMN loopscope.verdict_kind.weight IS 'How it counts in the ranking (parameter weight_...); null = no fault';
COMMENT ON COLUMN loopscope.verdict_kind.meaning IS 'What it means, in words';

-- schedule.result_slot_end names the slot, so that one partition is probed per loop instead of all.
CREATE VIEW loopscope.latest_verdict AS
  SELECT loop.loop_id, loop.name AS loop_name, loop.source, loop.loop_type, loop.importance, loop.enabled,
         verdict.slot_end, verdict.algorithm_revision, verdict.input_revision, verdict.analysis_id,
         verdict.code, verdict.confidence, verdict.p,
         verdict.summary, verdict.reasons, verdict.action, verdict.decided_at,
         analysis.window_start, analysis.window_end, analysis.usable, analysis.flags,
         analysis.ngi, analysis.nli, analysis.nonlinear_p, analysis.coupling,
         analysis.oscillating, analysis.oscillation_period_s, analysis.oscillation_p,
         analysis.harris_low, analysis.harris_high, analysis.harris_p, analysis.error_std,
         analysis.model_excited
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
COMMENT ON VIEW loopscope.latest_verdict IS 'One row per analysed loop: its newest verdict with the main figures behind it';
COMMENT ON COLUMN loopscope.latest_verdict.loop_name IS 'Name of the loop';

-- The false-discovery control, argued in core/plant/README.md and written a second time in
-- core/plant/false_discovery. The family is every test of every enabled loop; of a loop at most
-- the one that its verdict rests on can be flagged, and only where the verdict would be shown: all
-- others count with p = 1. What hides a verdict (confidence, annotation) therefore hides it before
-- the control and leaves the family as large as it was.
CREATE VIEW loopscope.flagged_loop AS
  WITH setting AS (
    SELECT max(value) FILTER (WHERE name = 'false_discovery_rate') AS false_discovery_rate,
           max(value) FILTER (WHERE name = 'false_discovery_dependence') AS false_discovery_dependence,
           max(value) FILTER (WHERE name = 'min_confidence') AS min_confidence
    FROM loopscope.parameter
  ), held AS (
    SELECT loop_id, array_agg(code) AS codes, bool_or(code IS NULL) AS whatever_the_code
    FROM loopscope.annotation
    WHERE withdrawn_at IS NULL AND (until IS NULL OR until > now())
    GROUP BY loop_id
  ), latest AS MATERIALIZED (
    SELECT latest_verdict.*, kind.weight AS kind_weight,
           -- A verdict that rests on a test belongs to the family even if its analysis shows none.
           -- A model that may claim something makes two: of the next effect, and of what is left.
           greatest(CASE WHEN usable THEN num_nonnulls(nonlinear_p, oscillation_p, harris_p)
                                          + CASE WHEN model_excited THEN 2 ELSE 0 END ELSE 0 END,
                    num_nonnulls(p)) AS tests,
           kind.is_fault AND confidence >= setting.min_confidence
             AND NOT coalesce(held.whatever_the_code OR latest_verdict.code = ANY (held.codes), false) AS shown
    FROM loopscope.latest_verdict
    JOIN loopscope.verdict_kind AS kind USING (code)
    LEFT JOIN held USING (loop_id)
    CROSS JOIN setting
    WHERE enabled
  ), family AS (
    SELECT sum(tests) AS m FROM latest
  ), scale AS MATERIALIZED (  -- once, not for every loop
    SELECT m * CASE WHEN false_discovery_dependence > 0
                    THEN (SELECT sum(1 / i::double precision) FROM generate_series(1, m) AS i) ELSE 1 END AS scaled_m
    FROM family CROSS JOIN setting
  ), ranked AS (
    SELECT p, row_number() OVER (ORDER BY p) AS i FROM latest WHERE shown AND p IS NOT NULL
  ), control AS (
    SELECT max(ranked.p) AS threshold
    FROM ranked CROSS JOIN scale CROSS JOIN setting
    WHERE ranked.p <= setting.false_discovery_rate * ranked.i / scale.scaled_m
  ), candidate AS (
    SELECT latest.*,
           -- What a perfect linear controller could win; the middle where the index is unknown.
           CASE WHEN harris_low IS NULL OR harris_high IS NULL THEN 0.5
                ELSE least(greatest(1 - (harris_low + harris_high) / 2, 0), 1) END AS severity,
           control.threshold AS false_discovery_threshold
    FROM latest CROSS JOIN control
    WHERE shown AND (p IS NULL OR p <= control.threshold)
  )
  SELECT row_number() OVER (ORDER BY severity * importance * kind_weight * confidence DESC, loop_id) AS rank,
         loop_id, loop_name, source, loop_type, code,
         severity * importance * kind_weight * confidence AS score,
         severity, importance, kind_weight, confidence,
         p, false_discovery_threshold, nonlinear_p,
         slot_end, algorithm_revision, input_revision, analysis_id,
         summary, reasons, action,
         ngi, nli, oscillation_period_s, harris_low, harris_high
  FROM candidate
  ORDER BY rank;
COMMENT ON VIEW loopscope.flagged_loop IS 'Loops that somebody should act on, worst first: faults of enabled loops that are facts or pass the false-discovery control, and are not annotated away';
COMMENT ON COLUMN loopscope.flagged_loop.rank IS '1 = act here first';
COMMENT ON COLUMN loopscope.flagged_loop.loop_name IS 'Name of the loop';
COMMENT ON COLUMN loopscope.flagged_loop.score IS 'severity x importance x kind_weight x confidence';
COMMENT ON COLUMN loopscope.flagged_loop.severity IS '1 minus the middle of the Harris index, 0 to 1; 0.5 where that is unknown';
COMMENT ON COLUMN loopscope.flagged_loop.kind_weight IS 'Weight of the kind of fault (parameter weight_...)';
COMMENT ON COLUMN loopscope.flagged_loop.false_discovery_threshold IS 'Largest p that is flagged today; null = none is, only facts';

CREATE VIEW loopscope.loop_history AS
  SELECT loop.loop_id, loop.name AS loop_name,
         verdict.slot_end, verdict.algorithm_revision, verdict.input_revision,
         verdict.input_revision = analysis.input_revision AS is_current,
         verdict.code, verdict.confidence, verdict.summary, verdict.action, verdict.decided_at,
         analysis.analysis_id, analysis.usable, analysis.ngi, analysis.nli, analysis.nonlinear_p,
         analysis.oscillating, analysis.oscillation_period_s,
         analysis.harris_low, analysis.harris_high, analysis.error_std,
         analysis.valve_travel_per_h, analysis.reversals_per_h,
         ARRAY(SELECT taken.effect FROM loopscope.explanation_step AS taken
               WHERE taken.loop_id = verdict.loop_id AND taken.slot_end = verdict.slot_end
                 AND taken.algorithm_revision = verdict.algorithm_revision
                 AND taken.input_revision = verdict.input_revision
               ORDER BY taken.step) AS effects
  FROM loopscope.loop
  JOIN loopscope.verdict USING (loop_id)
  LEFT JOIN loopscope.analysis
    ON analysis.loop_id = verdict.loop_id AND analysis.slot_end = verdict.slot_end
   AND analysis.algorithm_revision = verdict.algorithm_revision
   AND analysis.input_revision = verdict.input_revision;
COMMENT ON VIEW loopscope.loop_history IS 'Every verdict that was ever given, with the figures behind it while they are the current ones; ask for one loop_id and a span of slot_end';
COMMENT ON COLUMN loopscope.loop_history.loop_name IS 'Name of the loop';
COMMENT ON COLUMN loopscope.loop_history.effects IS 'What the loop model took in, in that order; explanation_step has the figures';
COMMENT ON COLUMN loopscope.loop_history.is_current IS 'True for the newest input revision; null = replaced when late data arrived';

CREATE VIEW loopscope.explanation AS
  SELECT latest.loop_id, latest.loop_name, latest.slot_end, latest.algorithm_revision, latest.input_revision,
         latest.code, taken.step, taken.effect, taken.parameters, taken.intervals,
         taken.holdout_error_before, taken.holdout_error_after,
         taken.holdout_error_after / nullif(taken.holdout_error_before, 0) AS error_ratio,
         taken.evidence, taken.p, taken.margin, taken.simulation_ratio, taken.steadiness, taken.statement
  FROM loopscope.latest_verdict AS latest
  JOIN loopscope.explanation_step AS taken USING (loop_id, slot_end, algorithm_revision, input_revision);
COMMENT ON VIEW loopscope.explanation IS 'One row per effect that the loop model took in, of the newest analysis of each loop: ask for one loop, ORDER BY step';
COMMENT ON COLUMN loopscope.explanation.loop_name IS 'Name of the loop';
COMMENT ON COLUMN loopscope.explanation.code IS 'The verdict that follows from the whole analysis';
COMMENT ON COLUMN loopscope.explanation.error_ratio IS 'Error on unseen samples after the step over that before it: below 1 = the effect explains something';

CREATE VIEW loopscope.before_after_maintenance AS
  WITH event AS (
    SELECT *, lead(done_at, 1, 'infinity') OVER work AS next_at, lag(done_at, 1, '-infinity') OVER work AS previous_at
    FROM loopscope.maintenance_event
    WINDOW work AS (PARTITION BY loop_id ORDER BY done_at, maintenance_event_id)
  )
  SELECT event.maintenance_event_id, event.loop_id, loop.name AS loop_name, event.done_at, event.kind, event.description,
         before.slot_end AS slot_end_before, after.slot_end AS slot_end_after,
         before.code AS code_before, after.code AS code_after,
         before.error_std AS error_std_before, after.error_std AS error_std_after,
         after.error_std / nullif(before.error_std, 0) AS error_std_ratio,
         before.harris_low AS harris_low_before, after.harris_low AS harris_low_after,
         before.ngi AS ngi_before, after.ngi AS ngi_after,
         before.nli AS nli_before, after.nli AS nli_after,
         before.oscillation_period_s AS oscillation_period_s_before, after.oscillation_period_s AS oscillation_period_s_after,
         before.valve_travel_per_h AS valve_travel_per_h_before, after.valve_travel_per_h AS valve_travel_per_h_after
  FROM event
  JOIN loopscope.loop USING (loop_id)
  -- Windows that lie wholly between two pieces of work: one that straddles them mixes both states.
  LEFT JOIN LATERAL (
    SELECT verdict.code, analysis.*
    FROM loopscope.analysis JOIN loopscope.verdict USING (loop_id, slot_end, algorithm_revision, input_revision)
    WHERE analysis.loop_id = event.loop_id AND analysis.slot_end <= event.done_at
      AND analysis.window_start >= event.previous_at AND analysis.usable
    ORDER BY analysis.slot_end DESC, analysis.algorithm_revision DESC LIMIT 1) AS before ON true
  LEFT JOIN LATERAL (
    SELECT verdict.code, analysis.*
    FROM loopscope.analysis JOIN loopscope.verdict USING (loop_id, slot_end, algorithm_revision, input_revision)
    WHERE analysis.loop_id = event.loop_id AND analysis.slot_end > event.done_at AND analysis.slot_end <= event.next_at
      AND analysis.window_start >= event.done_at AND analysis.usable
    ORDER BY analysis.slot_end DESC, analysis.algorithm_revision DESC LIMIT 1) AS after ON true;
COMMENT ON VIEW loopscope.before_after_maintenance IS 'One row per maintenance event: the last usable analysis before it beside the newest one after it (before the next event)';
COMMENT ON COLUMN loopscope.before_after_maintenance.loop_name IS 'Name of the loop';
COMMENT ON COLUMN loopscope.before_after_maintenance.slot_end_before IS 'Slot of the analysis before; null = none';
COMMENT ON COLUMN loopscope.before_after_maintenance.slot_end_after IS 'Slot of the analysis after; null = none yet';
COMMENT ON COLUMN loopscope.before_after_maintenance.code_before IS 'Verdict before';
COMMENT ON COLUMN loopscope.before_after_maintenance.code_after IS 'Verdict after';
COMMENT ON COLUMN loopscope.before_after_maintenance.error_std_before IS 'Standard deviation of the error before, pv units';
COMMENT ON COLUMN loopscope.before_after_maintenance.error_std_after IS 'Standard deviation of the error after, pv units';
COMMENT ON COLUMN loopscope.before_after_maintenance.error_std_ratio IS 'After over before: below 1 = better';
COMMENT ON COLUMN loopscope.before_after_maintenance.harris_low_before IS 'Harris index (low) before';
COMMENT ON COLUMN loopscope.before_after_maintenance.harris_low_after IS 'Harris index (low) after';
COMMENT ON COLUMN loopscope.before_after_maintenance.ngi_before IS 'Non-Gaussianity index before';
COMMENT ON COLUMN loopscope.before_after_maintenance.ngi_after IS 'Non-Gaussianity index after';
COMMENT ON COLUMN loopscope.before_after_maintenance.nli_before IS 'Nonlinearity index before';
COMMENT ON COLUMN loopscope.before_after_maintenance.nli_after IS 'Nonlinearity index after';
COMMENT ON COLUMN loopscope.before_after_maintenance.oscillation_period_s_before IS 'Period of the oscillation before, seconds';
COMMENT ON COLUMN loopscope.before_after_maintenance.oscillation_period_s_after IS 'Period of the oscillation after, seconds';
COMMENT ON COLUMN loopscope.before_after_maintenance.valve_travel_per_h_before IS 'Sum of op movements before, % of range per hour';
COMMENT ON COLUMN loopscope.before_after_maintenance.valve_travel_per_h_after IS 'Sum of op movements after, % of range per hour';

CREATE VIEW loopscope.plant_oscillation_member AS
  SELECT oscillation.slot_end, oscillation.algorithm_revision, oscillation.number, oscillation.period_s,
         loop.loop_id, loop.name AS loop_name, member.strength, member.lag_s,
         loop.loop_id IS NOT DISTINCT FROM oscillation.source_loop_id AS is_source, oscillation.statement
  FROM loopscope.plant_oscillation AS oscillation
  CROSS JOIN LATERAL unnest(oscillation.loop_ids, oscillation.strengths, oscillation.lags_s)
    AS member (loop_id, strength, lag_s)
  JOIN loopscope.loop ON loop.loop_id = member.loop_id;
COMMENT ON VIEW loopscope.plant_oscillation_member IS 'One row per loop that takes part in a shared oscillation';
COMMENT ON COLUMN loopscope.plant_oscillation_member.loop_name IS 'Name of the loop';
COMMENT ON COLUMN loopscope.plant_oscillation_member.strength IS 'Share of the loop''s error variance at that period, 0 to 1';
COMMENT ON COLUMN loopscope.plant_oscillation_member.lag_s IS 'How much later than the source the loop swings, seconds';
COMMENT ON COLUMN loopscope.plant_oscillation_member.is_source IS 'Whether the loop is the likely source';

CREATE VIEW loopscope.data_quality AS
  SELECT latest.loop_id, latest.loop_name, latest.source, latest.enabled, latest.slot_end,
         analysis.usable, analysis.unusable_reason, analysis.flags, analysis.samples, analysis.interval_s,
         analysis.missing_fraction, analysis.compression_factor, analysis.quantisation_factor,
         analysis.saturated_fraction, analysis.auto_fraction, analysis.segments
  FROM loopscope.latest_verdict AS latest
  CROSS JOIN LATERAL (
    SELECT * FROM loopscope.analysis AS measured
    WHERE measured.loop_id = latest.loop_id AND measured.slot_end = latest.slot_end
      AND measured.algorithm_revision = latest.algorithm_revision
    LIMIT 1) AS analysis;
COMMENT ON VIEW loopscope.data_quality IS 'One row per analysed loop: what its newest data are worth';
COMMENT ON COLUMN loopscope.data_quality.loop_name IS 'Name of the loop';

CREATE VIEW loopscope.monitor_health AS
  WITH health AS (
    SELECT loop.loop_id, loop.name AS loop_name, loop.source, loop.enabled, loop.period_s,
           schedule.last_slot_end,
           extract(epoch FROM now() - schedule.last_slot_end)::double precision AS age_s,
           schedule.attempts AS failures, schedule.last_error,
           CASE WHEN loop.enabled
                THEN greatest(extract(epoch FROM now() - schedule.visible_at), 0)::double precision END AS overdue_s,
           schedule.owner, schedule.owner IS NOT NULL AND schedule.visible_at > now() AS leased,
           loop.enabled AND schedule.last_slot_end IS NULL AS never_analysed,
           NOT latest.usable AS dead_data
    FROM loopscope.loop
    JOIN loopscope.schedule USING (loop_id)
    LEFT JOIN loopscope.latest_verdict AS latest USING (loop_id)
  )
  SELECT CASE WHEN NOT enabled THEN 'disabled'
              WHEN failures > 0 THEN 'failing'
              WHEN overdue_s > period_s THEN 'overdue'
              WHEN never_analysed THEN 'never_analysed'
              WHEN dead_data THEN 'dead_data'
              ELSE 'ok' END AS state,
         health.*
  FROM health;
COMMENT ON VIEW loopscope.monitor_health IS 'One row per loop: whether the monitor itself does its work there';
COMMENT ON COLUMN loopscope.monitor_health.state IS 'disabled, failing, overdue (by more than a period), never_analysed, dead_data or ok: the first that applies';
COMMENT ON COLUMN loopscope.monitor_health.loop_name IS 'Name of the loop';
COMMENT ON COLUMN loopscope.monitor_health.age_s IS 'Seconds since the end of the newest completed slot; null = never analysed';
COMMENT ON COLUMN loopscope.monitor_health.failures IS 'Failures in a row, lost leases included';
COMMENT ON COLUMN loopscope.monitor_health.overdue_s IS 'Seconds since the loop was due or its lease ended; null = disabled';
COMMENT ON COLUMN loopscope.monitor_health.leased IS 'Whether a worker holds it now';
COMMENT ON COLUMN loopscope.monitor_health.never_analysed IS 'Enabled, but no slot was completed yet';
COMMENT ON COLUMN loopscope.monitor_health.dead_data IS 'Whether the newest data could not be judged; null = never analysed';

-- A view's column that is named like a table's column means the same: take that comment over.
-- Where several tables have the name, the first of the list speaks.
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT DISTINCT ON (view.oid, shown.attnum) view.relname, shown.attname,
           col_description(source.attrelid, source.attnum) AS words
    FROM pg_class AS view
    JOIN pg_attribute AS shown ON shown.attrelid = view.oid AND shown.attnum > 0
    JOIN unnest('{analysis,verdict,loop,schedule,plant_oscillation,maintenance_event,explanation_step}'::text[])
      WITH ORDINALITY AS origin (name, priority) ON true
    JOIN pg_attribute AS source
      ON source.attrelid = format('loopscope.%I', origin.name)::regclass AND source.attname = shown.attname
    WHERE view.relnamespace = 'loopscope'::regnamespace AND view.relkind = 'v'
      AND col_description(view.oid, shown.attnum) IS NULL
    ORDER BY view.oid, shown.attnum, origin.priority
  LOOP
    EXECUTE format('COMMENT ON COLUMN loopscope.%I.%I IS %L', missing.relname, missing.attname, missing.words);
  END LOOP;
END $$;
