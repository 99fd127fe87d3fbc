-- Whether a repair worked: up to six windows on either side, every figure with its uncertainty, and one word for it.
-- The definitions of the words, and how often they are right, stand in storage/README.md.

ALTER TABLE loopscope.analysis ADD COLUMN error_log_variance_se double precision;
DO $$  -- a partition's columns have comments of their own
DECLARE part regclass; BEGIN
  FOR part IN SELECT relid FROM pg_partition_tree('loopscope.analysis') LOOP
    EXECUTE format('COMMENT ON COLUMN %s.error_log_variance_se IS %L', part, 'Standard error of ln(error_std^2), from the autocorrelation of the squared error; null = not computed, or written before schema version 13');
  END LOOP;
END $$;

-- Faults that one repair mends, and that the diagnosis may take for each other.
CREATE VIEW loopscope.fault_family (code, family, is_hardware) AS VALUES
  ('valve_stiction', 'friction', true), ('valve_deadband', 'friction', true), ('valve_oversized', 'friction', true),
  ('valve_saturation', 'limit', true), ('sensor_fault', 'sensor', true),
  ('valve_characteristic', 'curve', true), ('process_nonlinearity', 'curve', true),
  ('tight_tuning', 'oscillation', false), ('external_disturbance', 'oscillation', false), ('process_change', 'oscillation', false),
  ('sluggish_tuning', 'slowness', false), ('nonlinear_unexplained', 'unknown', false), ('unexplained', 'unknown', false);

-- Pieces of work on a loop without a usable window wholly between them are one job: what each of them did cannot be told apart.
CREATE VIEW loopscope.maintenance_job AS
  SELECT work.maintenance_event_id, work.loop_id, job.*
  FROM loopscope.maintenance_event AS work CROSS JOIN LATERAL (
    SELECT min(done_at) FILTER (WHERE number = own) AS begins_at, max(done_at) FILTER (WHERE number = own) AS ends_at,
           max(done_at) FILTER (WHERE number < own) AS previous_at, min(done_at) FILTER (WHERE number > own) AS next_at
    FROM (SELECT done_at, number, max(number) FILTER (WHERE done_at = work.done_at) OVER () AS own
      FROM (SELECT done_at, count(*) FILTER (WHERE EXISTS (
              SELECT FROM loopscope.analysis WHERE loop_id = work.loop_id AND usable AND slot_end > other.last_at AND slot_end <= other.done_at AND window_start >= other.last_at)) OVER (ORDER BY done_at) AS number
            FROM (SELECT done_at, lag(done_at) OVER (ORDER BY done_at) AS last_at FROM loopscope.maintenance_event WHERE loop_id = work.loop_id) AS other) AS counted) AS numbered) AS job;

-- Of each side the windows nearest to the work, six at most, none of which shares a sample with another. Each is
-- found by one step along the key from the last one; a year bounds the months that are looked into.
CREATE VIEW loopscope.maintenance_window AS
  WITH event AS (
    SELECT maintenance_event_id, loop_id, begins_at, ends_at, greatest(previous_at, begins_at - interval '1 year') AS from_at, least(next_at, ends_at + interval '1 year') AS to_at FROM loopscope.maintenance_job
  ), chosen AS (
    SELECT event.maintenance_event_id, event.loop_id, near.*
    FROM event CROSS JOIN LATERAL (
      WITH RECURSIVE before AS (
        SELECT 1 AS number, newest.* FROM (
          SELECT slot_end, algorithm_revision, window_start FROM loopscope.analysis
          WHERE loop_id = event.loop_id AND slot_end <= event.begins_at AND slot_end > event.from_at AND window_start >= event.from_at AND usable ORDER BY slot_end DESC, algorithm_revision DESC LIMIT 1) AS newest
        UNION ALL
        SELECT before.number + 1, earlier.* FROM before CROSS JOIN LATERAL (
          SELECT slot_end, algorithm_revision, window_start FROM loopscope.analysis
          WHERE loop_id = event.loop_id AND slot_end < before.window_start AND slot_end > event.from_at AND window_start >= event.from_at AND usable ORDER BY slot_end DESC, algorithm_revision DESC LIMIT 1) AS earlier
        WHERE before.number < 6
      ), after AS (
        SELECT 1 AS number, first.* FROM (
          SELECT slot_end, algorithm_revision, window_end FROM loopscope.analysis
          WHERE loop_id = event.loop_id AND slot_end > event.ends_at AND slot_end <= event.to_at AND window_start >= event.ends_at AND usable ORDER BY slot_end, algorithm_revision DESC LIMIT 1) AS first
        UNION ALL
        SELECT after.number + 1, later.* FROM after CROSS JOIN LATERAL (
          SELECT slot_end, algorithm_revision, window_end FROM loopscope.analysis
          WHERE loop_id = event.loop_id AND slot_end > after.window_end AND slot_end <= event.to_at AND window_start > after.window_end AND usable ORDER BY slot_end, algorithm_revision DESC LIMIT 1) AS later
        WHERE after.number < 6
      )
      SELECT 'before' AS side, number, slot_end, algorithm_revision FROM before
      UNION ALL SELECT 'after', number, slot_end, algorithm_revision FROM after) AS near
  )
  SELECT chosen.maintenance_event_id, chosen.loop_id, chosen.side, chosen.number,
         chosen.slot_end, chosen.algorithm_revision, analysis.input_revision, analysis.analysis_id, analysis.window_start, analysis.window_end,
         verdict.code, verdict.confidence, CASE WHEN verdict.confidence >= setting.min_confidence THEN kin.family END AS family,
         analysis.error_std, analysis.error_log_variance_se, sqrt(analysis.harris_low * analysis.harris_high) AS harris,
         analysis.ngi, analysis.nli, analysis.nonlinear_p, analysis.oscillating, analysis.oscillation_period_s, analysis.oscillation_amplitude, analysis.valve_travel_per_h,
         CASE WHEN pi.fit > 0.9 THEN abs(pi.gain) END AS controller_gain, CASE WHEN pi.fit > 0.9 THEN abs(pi.time) END AS integral_time_s
  FROM chosen
  CROSS JOIN LATERAL (
    SELECT * FROM loopscope.analysis AS measured
    WHERE measured.loop_id = chosen.loop_id AND measured.slot_end = chosen.slot_end AND measured.algorithm_revision = chosen.algorithm_revision LIMIT 1) AS analysis
  CROSS JOIN LATERAL (
    SELECT * FROM loopscope.verdict AS given
    WHERE given.loop_id = chosen.loop_id AND given.slot_end = chosen.slot_end AND given.algorithm_revision = chosen.algorithm_revision AND given.input_revision = analysis.input_revision LIMIT 1) AS verdict
  CROSS JOIN LATERAL (SELECT (loop->>'controller_fit')::float8 AS fit, (loop->>'controller_gain')::float8 AS gain, (loop->>'integral_time_s')::float8 AS time
    FROM (SELECT analysis.model->'closed_loop' AS loop) AS model) AS pi
  LEFT JOIN loopscope.fault_family AS kin ON kin.code = verdict.code
  CROSS JOIN (SELECT max(value) FILTER (WHERE name = 'min_confidence') AS min_confidence FROM loopscope.parameter) AS setting;

-- What is compared. `ordinary` and `apart` were measured on simulated loops that nobody touched (storage/README.md).
CREATE VIEW loopscope.figure_kind (figure, effect, parameter, family, is_ratio, ordinary, apart, unit, meaning) AS VALUES
  ('error_std', NULL, NULL, NULL, true, 0.07, 0.12, 'pv units', 'Standard deviation of the error'),
  ('cost', NULL, NULL, NULL, true, 0.12, 0.12, 'pv units', 'error_std over the root of the Harris index: half of it counts what the error is, half what a better controller could take away'),
  ('harris', NULL, NULL, NULL, true, 0.15, 0.05, '0 to 1', 'Harris index, middle of the plausible delays'), ('ngi', NULL, NULL, NULL, false, 0.0015, 0.0, '', 'Non-Gaussianity index'),
  ('nli', NULL, NULL, NULL, false, 0.03, 0.0, '', 'Nonlinearity index'), ('nonlinear_p', NULL, NULL, NULL, false, 1.0, 0.0, 'powers of ten', 'Evidence for nonlinearity: -log10 of nonlinear_p, at most 30'),
  ('oscillation_share', NULL, NULL, NULL, false, 0.1, 0.1, '0 to 1', 'Share of the error''s variance that the oscillation carries; 0 = none'), ('valve_travel_per_h', NULL, NULL, NULL, true, 0.12, 0.12, '%/h', 'Sum of op movements'),
  ('controller_gain', NULL, NULL, NULL, true, 0.01, 0.01, '%/pv', 'Gain of the PI controller, as the loop model reads it from op'), ('integral_time_s', NULL, NULL, NULL, true, 0.01, 0.01, 's', 'Its integral time'),
  ('valve_stiction.S', 'valve_stiction', 'S', NULL, true, 0.12, 0.08, '% of op', 'Stick band of the valve'), ('valve_stiction.J', 'valve_stiction', 'J', NULL, true, 0.3, 0.1, '% of op', 'Slip jump of the valve'),
  ('valve_deadband.width', 'valve_deadband', 'width', NULL, true, 0.12, 0.08, '% of op', 'Full width of the valve''s play'),
  ('friction_band', 'valve_stiction', 'S', 'friction', true, 0.12, 0.08, '% of op', 'What the valve loses at a reversal: stick band or play'),
  ('friction_band', 'valve_deadband', 'width', 'friction', true, 0.12, 0.08, '% of op', 'What the valve loses at a reversal: stick band or play'),
  ('curvature', 'valve_characteristic', 'curvature', 'curve', true, 0.12, 0.08, '', 'Curvature of valve or process'), ('curvature', 'process_nonlinearity', 'curvature', 'curve', true, 0.12, 0.08, '', 'Curvature of valve or process'),
  ('valve_saturation.low', 'valve_saturation', 'low', NULL, false, 2.0, 1.0, '% of op', 'Lower limit of the valve'), ('valve_saturation.high', 'valve_saturation', 'high', NULL, false, 2.0, 1.0, '% of op', 'Upper limit of the valve'),
  ('external_oscillation.amplitude', 'external_oscillation', 'amplitude', 'oscillation', true, 0.12, 0.08, 'pv units', 'Amplitude of the sinusoid from outside'),
  ('external_oscillation.period_s', 'external_oscillation', 'period_s', NULL, true, 0.05, 0.05, 's', 'Its period'), ('sensor_quantisation.step', 'sensor_quantisation', 'step', 'sensor', true, 0.12, 0.08, 'pv units', 'Grid of the sensor'),
  ('sensor_hold.samples', 'sensor_hold', 'samples', 'sensor', true, 0.12, 0.08, 'samples', 'How long the sensor holds a value');

-- Windows of one side scatter. That scatter is pooled over both sides and drawn towards what is ordinary for the figure,
-- as if that were known from four windows more (Smyth 2004), so that a single window has an interval too.
DROP VIEW loopscope.before_after_maintenance;
CREATE VIEW loopscope.before_after_maintenance AS
  SELECT work.maintenance_event_id, work.loop_id, loop.name AS loop_name, work.done_at, work.kind, work.description,
         before.slot_end AS slot_end_before, after.slot_end AS slot_end_after, before.code AS code_before, after.code AS code_after,
         before.error_std AS error_std_before, after.error_std AS error_std_after, after.error_std / nullif(before.error_std, 0) AS error_std_ratio,
         before.harris_low AS harris_low_before, after.harris_low AS harris_low_after,
         before.ngi AS ngi_before, after.ngi AS ngi_after, before.nli AS nli_before, after.nli AS nli_after,
         before.oscillation_period_s AS oscillation_period_s_before, after.oscillation_period_s AS oscillation_period_s_after,
         before.valve_travel_per_h AS valve_travel_per_h_before, after.valve_travel_per_h AS valve_travel_per_h_after,
         judged.word,
         CASE
           WHEN n_before = 0 THEN 'Not judged: no usable window lies before this work and after any earlier one.'
           WHEN n_after = 0 THEN coalesce('Not judged yet: the data after the work cannot be used: ' || refused.unusable_reason || '.',
                                          'Not judged yet: no window lies wholly after the work and before the next.')
           WHEN word = 'fixed' THEN format('Fixed: %s, which %s before, is gone; ', was, stood)
           WHEN is_now IS NULL THEN initcap(word) || ': ' || CASE WHEN word = 'unchanged' THEN format('no fault stands%s; ', ', before it was ' || was) ELSE '' END
           WHEN family_before IS DISTINCT FROM family_after THEN format('%s: %s (%s) %s; ', initcap(word), is_now, stand,
             CASE word WHEN 'worse' THEN 'is new' ELSE 'stands' END || coalesce(', before it was ' || was, ', before there was no fault'))
           ELSE format('%s: %s (%s) ', initcap(word), is_now, stand) || CASE word WHEN 'improved' THEN 'is left, but less' WHEN 'worse' THEN 'still stands, and more'
             ELSE 'stands as before' END || '; ' || size_text
         END || CASE WHEN word IS NULL THEN '' ELSE spread_text END
         || CASE WHEN word = 'fixed' AND is_now IS NOT NULL THEN format(' What is left: %s (%s).', is_now, stand) ELSE '' END
         || CASE WHEN word = 'fixed' AND back.family = family_before AND after.confidence >= min_confidence
                 THEN format(' It is back in the newest window, of %s UTC.', to_char(after.slot_end AT TIME ZONE 'UTC', 'YYYY-MM-DD HH24:MI')) ELSE '' END AS statement,
         n_before::integer AS windows_before, n_after::integer AS windows_after, fault_before, fault_after, variance_ratio, variance_ratio_low, variance_ratio_high, figures
  FROM loopscope.maintenance_event AS work JOIN loopscope.loop USING (loop_id)
  CROSS JOIN LATERAL (
    WITH seen AS MATERIALIZED (
      SELECT shown.*, kin.family AS suspected, kin.is_hardware, CASE WHEN shown.family IS NULL THEN -confidence ELSE confidence END AS blame
      FROM loopscope.maintenance_window AS shown LEFT JOIN loopscope.fault_family AS kin USING (code)
      WHERE shown.maintenance_event_id = work.maintenance_event_id
    ), told AS (
      SELECT count(*) FILTER (WHERE side = 'before') AS n_before, count(*) FILTER (WHERE side = 'after') AS n_after,
             sum(blame) FILTER (WHERE side = 'before') >= 0 AS faulty_before, sum(blame) FILTER (WHERE side = 'after') >= 0 AS faulty_after,
             bool_or(code = 'valve_oversized') AS oversized FROM seen
    ), standing AS (
      SELECT DISTINCT ON (side) * FROM (
        SELECT side, family IS NOT NULL AS stands, suspected AS family, bool_or(is_hardware) AS is_hardware, sum(confidence) AS weight,
               avg(confidence) AS sure, count(*) AS windows, mode() WITHIN GROUP (ORDER BY code) AS code
        FROM seen WHERE suspected IS NOT NULL GROUP BY side, stands, suspected) AS weighed
      ORDER BY side, stands DESC, weight DESC, family
    ), measured AS (
      SELECT side, own_error, kind.*, CASE WHEN NOT kind.is_ratio THEN value WHEN value > 0 THEN ln(value) END AS y
      FROM (
        SELECT side, taken.* FROM seen CROSS JOIN LATERAL (VALUES
          ('error_std', error_std, coalesce(error_log_variance_se, 0) / 2),
          ('cost', error_std / sqrt(nullif(harris, 0)), coalesce(error_log_variance_se, 0) / 2),
          ('harris', harris, 0), ('ngi', ngi, 0), ('nli', nli, 0), ('nonlinear_p', -log(greatest(nonlinear_p, 1e-30)), 0),
          ('oscillation_share', CASE WHEN oscillating THEN least(oscillation_amplitude ^ 2 / nullif(2 * error_std ^ 2, 0), 1) ELSE 0 END, 0),
          ('valve_travel_per_h', valve_travel_per_h, 0), ('controller_gain', controller_gain, 0), ('integral_time_s', integral_time_s, 0)
        ) AS taken (figure, value, own_error)
        UNION ALL
        SELECT side, figure, value, 0 FROM (  -- an effect that was taken in twice counts once: the step that came first
          SELECT DISTINCT ON (seen.side, seen.number, kind.figure) seen.side, kind.figure,
                 CASE WHEN kind.is_ratio THEN abs((step.parameters->>kind.parameter)::float8) ELSE (step.parameters->>kind.parameter)::float8 END AS value
          FROM seen JOIN loopscope.explanation_step AS step ON step.loop_id = work.loop_id AND step.slot_end = seen.slot_end
           AND step.algorithm_revision = seen.algorithm_revision AND step.input_revision = seen.input_revision
          JOIN loopscope.figure_kind AS kind ON kind.effect = step.effect
          ORDER BY seen.side, seen.number, kind.figure, step.step) AS fitted
      ) AS raw
      JOIN (SELECT DISTINCT figure, family, is_ratio, ordinary, apart FROM loopscope.figure_kind) AS kind USING (figure)
    ), pooled AS (
      SELECT figure, family, is_ratio, ordinary, apart, avg(own_error ^ 2) AS own,
             count(y) FILTER (WHERE side = 'before') AS n_before, count(y) FILTER (WHERE side = 'after') AS n_after,
             avg(y) FILTER (WHERE side = 'before') AS y_before, avg(y) FILTER (WHERE side = 'after') AS y_after,
             coalesce(regr_sxx(y, y) FILTER (WHERE side = 'before'), 0) + coalesce(regr_sxx(y, y) FILTER (WHERE side = 'after'), 0) AS squares
      FROM measured WHERE y IS NOT NULL GROUP BY figure, family, is_ratio, ordinary, apart
    ), shown AS (
      SELECT figure, family, is_ratio, n_before, n_after, step.change / half.w AS weight, ends.*
      FROM pooled CROSS JOIN LATERAL (SELECT 4 + greatest(n_before - 1, 0) + greatest(n_after - 1, 0) AS freedom, y_after - y_before AS change) AS step
      CROSS JOIN LATERAL (  -- Cornish and Fisher: the 95 % point of Student's t
        SELECT (4 * (ordinary ^ 2 + own) + squares) / freedom AS scatter, 1.645 + 1.524 / freedom + 1.42 / freedom ^ 2 AS t) AS known
      CROSS JOIN LATERAL (
        SELECT t * sqrt(scatter / nullif(n_before, 0)) AS w_before, t * sqrt(scatter / nullif(n_after, 0)) AS w_after,
               t * sqrt(scatter / nullif(n_before, 0) + scatter / nullif(n_after, 0) + apart ^ 2) AS w) AS half
      CROSS JOIN LATERAL (
        SELECT y_before AS before, y_before - w_before AS before_low, y_before + w_before AS before_high,
               y_after AS after, y_after - w_after AS after_low, y_after + w_after AS after_high,
               step.change AS change, step.change - w AS change_low, step.change + w AS change_high WHERE NOT is_ratio
        UNION ALL
        SELECT exp(y_before), exp(y_before - w_before), exp(y_before + w_before), exp(y_after), exp(y_after - w_after), exp(y_after + w_after),
               exp(step.change), exp(step.change - w), exp(step.change + w) WHERE is_ratio) AS ends
    ), compared AS (
      SELECT coalesce(max(weight) FILTER (WHERE figure = 'cost'), max(weight) FILTER (WHERE figure = 'error_std'), 0) AS cost, coalesce(max(weight) FILTER (WHERE figure = 'error_std'), 0) AS spread,
             max(abs(ln(change))) FILTER (WHERE figure IN ('controller_gain', 'integral_time_s')) AS retuned,
             sum(ln(change) * CASE figure WHEN 'controller_gain' THEN 1 ELSE -0.5 END) FILTER (WHERE figure IN ('controller_gain', 'integral_time_s')) AS tighter,
             jsonb_object_agg(figure, to_jsonb(shown) - '{figure,family,weight}'::text[]) AS figures FROM shown
    ), evidence AS (
      SELECT told.*, compared.*, deviation.change ^ 2 AS variance_ratio, deviation.change_low ^ 2 AS variance_ratio_low, deviation.change_high ^ 2 AS variance_ratio_high,
             was.code AS fault_before, was.family AS family_before, was.windows AS faults_before, was.sure AS sure_before, was.is_hardware AS hardware_before,
             suspicion, stands.code AS fault_after, stands.family AS family_after, stands.windows AS faults_after, stands.sure AS sure_after, stands.is_hardware AS hardware_after,
             format('the error''s standard deviation went from %s to %s (x %s, 90 %% interval %s to %s).', to_char(deviation.before, '9.99EEEE')::float8,
               to_char(deviation.after, '9.99EEEE')::float8, round(deviation.change::numeric, 2), round(deviation.change_low::numeric, 2), round(deviation.change_high::numeric, 2)) AS spread_text
      FROM told CROSS JOIN compared
      LEFT JOIN shown AS deviation ON deviation.figure = 'error_std'
      LEFT JOIN standing AS was ON was.side = 'before' AND faulty_before
      LEFT JOIN (SELECT code AS suspicion FROM standing WHERE side = 'before' AND family <> 'unknown') AS doubted ON NOT faulty_before
      LEFT JOIN standing AS stands ON stands.side = 'after' AND faulty_after
    )
    SELECT evidence.*, translate(coalesce(fault_before, suspicion), '_', ' ') AS was, translate(fault_after, '_', ' ') AS is_now,
      coalesce('stood in ' || faults_before || ' of ' || evidence.n_before || ' windows', 'was suspected') AS stood, format('%s of %s windows', faults_after, evidence.n_after) AS stand,
      CASE WHEN sized.figure IS NULL THEN '' ELSE format('its %s went from %s to %s; ', translate(sized.figure, '_.', '  '),
        to_char(sized.before, '9.99EEEE')::float8, to_char(sized.after, '9.99EEEE')::float8) END AS size_text,
      CASE
        WHEN evidence.n_before = 0 OR evidence.n_after = 0 THEN NULL
        WHEN family_before IS NULL THEN
          CASE WHEN hardware_after OR (sure_after >= 0.75 AND cost > 0) OR (detuned AND cost > 0) OR (cost > 1 AND spread > 0.5) THEN 'worse'
               WHEN cost < -1 AND spread < -0.5 THEN CASE WHEN spread < -1 AND suspicion IS NOT NULL AND family_after IS NULL THEN 'fixed' ELSE 'improved' END ELSE 'unchanged' END
        WHEN family_after = family_before OR (family_before = 'unknown' AND hardware_after AND cost <= 1) OR (hardware_before AND fault_after = 'nonlinear_unexplained') THEN
          CASE WHEN sized.weight < -1 THEN 'improved' WHEN sized.weight > 1 THEN 'worse' WHEN cost < -needed THEN 'improved' WHEN cost > needed THEN 'worse'
               WHEN retuned > 0.03 AND fault_before LIKE '%tuning' THEN CASE WHEN detuned THEN 'worse' ELSE 'improved' END ELSE 'unchanged' END
        WHEN hardware_after THEN CASE WHEN cost > -0.5 THEN 'worse' ELSE 'improved' END
        WHEN cost > 1 AND spread > 1 THEN 'worse'
        WHEN hardware_before OR sure_before >= 0.75 OR cost < -0.5 THEN 'fixed' ELSE 'unchanged' END AS word
    FROM evidence
    LEFT JOIN LATERAL (
      SELECT * FROM shown WHERE shown.family = family_before AND shown.family = family_after AND shown.weight IS NOT NULL AND (shown.family = 'friction' AND (oversized OR retuned > 0.03)) IS NOT TRUE
      ORDER BY shown.n_before + shown.n_after DESC, figure LIMIT 1) AS sized ON true
    CROSS JOIN LATERAL (
      SELECT coalesce(CASE coalesce(fault_before, fault_after) WHEN 'tight_tuning' THEN tighter > 0.03 WHEN 'sluggish_tuning' THEN tighter < -0.03 END, false) AS detuned,
             CASE WHEN fault_before LIKE '%tuning' THEN CASE WHEN retuned <= 0.03 THEN 2 ELSE 1 END WHEN retuned > 0.03 THEN 0.6
                  WHEN abs(sized.weight) < 0.5 THEN 1.5 ELSE 1 END AS needed) AS limits
  ) AS judged
  -- Windows that lie wholly between two jobs: one that straddles them mixes both states.
  CROSS JOIN LATERAL (SELECT begins_at, ends_at, coalesce(previous_at, '-infinity') AS previous_at, coalesce(next_at, 'infinity') AS next_at FROM loopscope.maintenance_job AS job WHERE job.maintenance_event_id = work.maintenance_event_id) AS span
  LEFT JOIN LATERAL (
    SELECT code, analysis.* FROM loopscope.analysis JOIN loopscope.verdict USING (loop_id, slot_end, algorithm_revision, input_revision)
    WHERE analysis.loop_id = work.loop_id AND analysis.slot_end <= span.begins_at AND analysis.window_start >= span.previous_at AND analysis.usable
    ORDER BY analysis.slot_end DESC, analysis.algorithm_revision DESC LIMIT 1) AS before ON true
  LEFT JOIN LATERAL (
    SELECT verdict.code, verdict.confidence, analysis.* FROM loopscope.analysis JOIN loopscope.verdict USING (loop_id, slot_end, algorithm_revision, input_revision)
    WHERE analysis.loop_id = work.loop_id AND analysis.slot_end > span.ends_at AND analysis.slot_end <= span.next_at AND window_start >= span.ends_at AND usable
    ORDER BY analysis.slot_end DESC, analysis.algorithm_revision DESC LIMIT 1) AS after ON true
  LEFT JOIN LATERAL (
    SELECT unusable_reason FROM loopscope.analysis WHERE loop_id = work.loop_id AND slot_end > span.ends_at AND slot_end <= span.next_at AND window_start >= span.ends_at AND NOT usable
    ORDER BY slot_end DESC LIMIT 1) AS refused ON true
  LEFT JOIN loopscope.fault_family AS back ON back.code = after.code
  CROSS JOIN (SELECT max(value) FILTER (WHERE name = 'min_confidence') AS min_confidence FROM loopscope.parameter) AS setting;

CREATE VIEW loopscope.maintenance_figure AS
  SELECT maintenance_event_id, loop_id, each.figure, kind.unit, kind.meaning, value.n_before AS windows_before, value.before, value.before_low, value.before_high,
         value.n_after AS windows_after, value.after, value.after_low, value.after_high, value.is_ratio, value.change, value.change_low, value.change_high
  FROM loopscope.before_after_maintenance
  CROSS JOIN LATERAL jsonb_each(figures) AS each (figure, object) CROSS JOIN LATERAL jsonb_to_record(object) AS value (n_before integer, before float8, before_low float8, before_high float8,
    n_after integer, after float8, after_low float8, after_high float8, is_ratio boolean, change float8, change_low float8, change_high float8)
  JOIN (SELECT DISTINCT figure, unit, meaning FROM loopscope.figure_kind) AS kind USING (figure);

COMMENT ON VIEW loopscope.fault_family IS 'Faults by the repair that mends them: what one repair mends, and what the diagnosis may take for each other, is one family';
COMMENT ON VIEW loopscope.maintenance_job IS 'The job that each piece of work belongs to: work on a loop without a usable window wholly between is one job, and has one before and after';
COMMENT ON VIEW loopscope.maintenance_window IS 'The windows that before_after_maintenance compares: of each side the nearest to the job, six at most, wholly between two jobs, none of which shares a sample with another';
COMMENT ON VIEW loopscope.figure_kind IS 'What maintenance_figure compares, one row per figure and effect that has it';
COMMENT ON VIEW loopscope.maintenance_figure IS 'One row per maintenance event and figure: mean before and after, and the change, each with its 90 % interval; ask for one event';
COMMENT ON VIEW loopscope.before_after_maintenance IS 'One row per maintenance event: whether the work fixed the loop, by up to six windows on either side; and the newest usable analysis on either side in figures';

-- {side} stands for before and after. What is left is named like a table's column, means the same, and takes that comment over.
DO $$
DECLARE said record; BEGIN
  FOR said IN
    SELECT told.view, replace(one.key, '{side}', side.name) AS attname, replace(one.value, '{side}', side.name) AS words
    FROM (VALUES
      ('fault_family', '{"code": "The verdict", "family": "friction, limit, curve, sensor, oscillation, slowness or unknown", "is_hardware": "Whether something of the loop itself is to be repaired"}'::jsonb),
      ('maintenance_job', '{"begins_at": "When the first piece of the job was done", "ends_at": "When the last one was done", "previous_at": "When the job before it ended; null = there is none", "next_at": "When the next one began; null = not yet"}'::jsonb),
      ('maintenance_window', '{"side": "before or after", "number": "1 = nearest to the work", "family": "Family of the fault (fault_family); null = no fault, or less sure than min_confidence",
        "harris": "Harris index, geometric middle of the plausible delays",
        "controller_gain": "Gain of the PI controller as the loop model reads it from op, absolute; null = op does not follow a PI law",
        "integral_time_s": "Integral time of the PI controller, seconds"}'::jsonb),
      ('figure_kind', '{"figure": "Name of the figure", "effect": "Effect of the loop model that has it as a parameter; null = a figure of the window", "parameter": "Name of the parameter",
        "family": "Family of faults whose size it is; null = it sizes none", "is_ratio": "True: compared as a ratio (by logarithms); false: as a difference",
        "ordinary": "Ordinary standard deviation from window to window, of the logarithm where is_ratio",
        "apart": "Ordinary standard deviation between two states of a loop that nobody touched, whatever the number of windows", "unit": "Unit", "meaning": "What it is"}'::jsonb),
      ('maintenance_figure', '{"figure": "Name of the figure (figure_kind)", "unit": "Its unit", "meaning": "What it is", "windows_{side}": "Windows {side} the work that have it",
        "{side}": "Mean {side} the work (geometric where is_ratio); null = no window has it", "{side}_low": "Lower end of its 90 % interval",
        "{side}_high": "Upper end of its 90 % interval", "is_ratio": "True: change is after over before; false: after less before",
        "change": "The change; null = one side has no such figure", "change_low": "Lower end of its 90 % interval, which holds the ordinary change of a loop that nobody touched",
        "change_high": "Upper end of its 90 % interval"}'::jsonb),
      ('before_after_maintenance', '{"loop_name": "Name of the loop", "slot_end_before": "Slot of the last usable analysis before the work (the figures ..._before); null = none",
        "slot_end_after": "Slot of the newest usable analysis after the work and before the next (the figures ..._after); null = none yet", "code_{side}": "Verdict {side}",
        "error_std_{side}": "Standard deviation of the error {side}, pv units", "error_std_ratio": "After over before: below 1 = better", "harris_low_{side}": "Harris index (low) {side}",
        "ngi_{side}": "Non-Gaussianity index {side}", "nli_{side}": "Nonlinearity index {side}", "oscillation_period_s_{side}": "Period of the oscillation {side}, seconds",
        "valve_travel_per_h_{side}": "Sum of op movements {side}, % of range per hour",
        "word": "fixed, improved, unchanged or worse (storage/README.md defines them); null = cannot be said, statement says why",
        "statement": "The word in a sentence or two with its figures; without a word, why there is none",
        "windows_{side}": "Windows {side} the work that were compared (maintenance_window)",
        "fault_{side}": "Fault that stands in the windows {side}: the family with most confidence, where faults have half of all confidence; null = none",
        "variance_ratio": "Variance of the error after over before, over all compared windows: below 1 = better",
        "variance_ratio_low": "Lower end of its 90 % interval, which holds the ordinary change of a loop that nobody touched", "variance_ratio_high": "Upper end of its 90 % interval",
        "figures": "Every figure by name, with means, 90 % intervals and numbers of windows; maintenance_figure has them as rows"}'::jsonb)
    ) AS told (view, comments)
    CROSS JOIN LATERAL jsonb_each_text(comments) AS one
    CROSS JOIN (VALUES ('before'), ('after')) AS side (name) WHERE side.name = 'before' OR one.key LIKE '%{side}%'
    UNION ALL
    (SELECT DISTINCT ON (view.oid, shown.attnum) view.relname, shown.attname, col_description(source.attrelid, source.attnum)
    FROM unnest('{maintenance_job,maintenance_window,before_after_maintenance,maintenance_figure}'::text[]) AS made (name)
    JOIN pg_class AS view ON view.oid = format('loopscope.%I', made.name)::regclass JOIN pg_attribute AS shown ON shown.attrelid = view.oid AND shown.attnum > 0
    JOIN unnest('{analysis,verdict,maintenance_event,loop}'::text[]) WITH ORDINALITY AS origin (name, priority) ON true
    JOIN pg_attribute AS source ON source.attrelid = format('loopscope.%I', origin.name)::regclass AND source.attname = shown.attname
    ORDER BY view.oid, shown.attnum, origin.priority)
  LOOP CONTINUE WHEN col_description(format('loopscope.%I', said.view)::regclass,
      (SELECT attnum FROM pg_attribute WHERE attrelid = format('loopscope.%I', said.view)::regclass AND attname = said.attname)) IS NOT NULL;
    EXECUTE format('COMMENT ON COLUMN loopscope.%I.%I IS %L', said.view, said.attname, said.words);
  END LOOP;
END $$;
