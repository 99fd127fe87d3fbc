-- States of a loop that are no fault and no health; what tells a dead transmitter from a calm loop; whose loop it is.

ALTER TABLE loopscope.loop ADD COLUMN area text CHECK (area <> ''), ADD COLUMN unit text CHECK (unit <> ''), ADD COLUMN description text CHECK (description <> ''),
  ADD COLUMN pv_unit text CHECK (pv_unit <> ''), ADD COLUMN owner text CHECK (owner <> ''),
  ADD COLUMN pv_low double precision, ADD COLUMN pv_high double precision,
  ADD CONSTRAINT loop_pv_range CHECK ((pv_low IS NULL) = (pv_high IS NULL) AND (pv_low IS NULL OR pv_low < pv_high));
COMMENT ON COLUMN loopscope.loop.pv_low IS 'pv at 0 % of its transmitter; null = range unknown'; COMMENT ON COLUMN loopscope.loop.pv_high IS 'pv at 100 % of its transmitter; null = range unknown';
COMMENT ON COLUMN loopscope.loop.area IS 'Area of the plant; null = not said'; COMMENT ON COLUMN loopscope.loop.unit IS 'Process unit within the area; null = not said';
COMMENT ON COLUMN loopscope.loop.description IS 'What the loop controls, in words; null = not said';
COMMENT ON COLUMN loopscope.loop.pv_unit IS 'Unit of sp and pv, such as m3/h; null = not said';
COMMENT ON COLUMN loopscope.loop.owner IS 'Who looks after the loop; null = not said';

-- What is stored satisfies the narrower check of before: no table is read, under whatever lock.
ALTER TABLE loopscope.verdict DROP CONSTRAINT verdict_code_check, ADD CONSTRAINT verdict_code_check CHECK (code IN (
  'healthy', 'valve_stiction', 'valve_deadband', 'valve_saturation', 'valve_characteristic', 'valve_oversized', 'process_nonlinearity',
  'external_disturbance', 'process_change', 'sensor_fault', 'tight_tuning', 'sluggish_tuning', 'nonlinear_unexplained', 'unexplained',
  'not_controlling', 'insufficient_data')) NOT VALID;

ALTER TABLE loopscope.analysis ADD COLUMN control_fraction double precision, ADD COLUMN control_lost_by text, ADD COLUMN control_lost_at timestamptz,
  ADD COLUMN op_range_doubt text,
  ADD COLUMN past_pv_flat_s double precision, ADD COLUMN past_pv_step double precision,
  ADD CONSTRAINT analysis_control_lost_by_check CHECK (control_lost_by IN ('mode', 'constant_output')) NOT VALID;
COMMENT ON COLUMN loopscope.analysis.control_fraction IS 'Share of the window in which a controller acted, by the mode or by op; null = neither is recorded, or a program before schema 23';
COMMENT ON COLUMN loopscope.analysis.control_lost_by IS 'What says that none did: mode (manual, tracking, out of service) or constant_output; null = one acted all the time';
COMMENT ON COLUMN loopscope.analysis.control_lost_at IS 'Start of the stretch without a controller that lasts up to the window''s end, as far as the window shows; null = one acts at the end';
COMMENT ON COLUMN loopscope.analysis.op_range_doubt IS 'Why the range of op in the catalogue cannot be right; null = it can, or none is set';
COMMENT ON COLUMN loopscope.analysis.past_pv_flat_s IS 'schedule.pv_flat_s as it was when this window was judged; null = nothing was known';
COMMENT ON COLUMN loopscope.analysis.past_pv_step IS 'schedule.pv_step as it was when this window was judged; null = nothing was known';
COMMENT ON COLUMN loopscope.analysis.usable IS 'Whether the statistics could be computed and a controller acted: false also for not_controlling and for a measurement that stands still all the time';

-- What the next window has to know of those before it. Not of the analyses themselves: a claim waits for none of their locks.
ALTER TABLE loopscope.schedule ADD COLUMN pv_flat_s double precision, ADD COLUMN pv_step double precision;
COMMENT ON COLUMN loopscope.schedule.pv_flat_s IS 'Longest run of equal values of pv that is usual for the loop, seconds, of all windows so far, without what stands still and should not; null = not known';
COMMENT ON COLUMN loopscope.schedule.pv_step IS 'Smallest usual step of pv, pv units; null = not known';

-- A partition's columns have comments of their own.
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT part.inhrelid::regclass AS name, own.attname, col_description(part.inhparent, whole.attnum) AS words
    FROM pg_inherits AS part
    JOIN pg_attribute AS own ON own.attrelid = part.inhrelid AND own.attnum > 0 AND NOT own.attisdropped
    JOIN pg_attribute AS whole ON whole.attrelid = part.inhparent AND whole.attname = own.attname
    WHERE part.inhparent = 'loopscope.analysis'::regclass AND col_description(part.inhrelid, own.attnum) IS DISTINCT FROM col_description(part.inhparent, whole.attnum)
  LOOP
    EXECUTE format('COMMENT ON COLUMN %s.%I IS %L', missing.name, missing.attname, missing.words);
  END LOOP;
END $$;

CREATE OR REPLACE VIEW loopscope.verdict_kind (code, is_fault, weight, meaning) AS
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
    ('sensor_fault', true, 'The measurement is frozen, held or coarse'),
    ('tight_tuning', true, 'The controller is tuned too tightly'),
    ('sluggish_tuning', true, 'The controller is tuned too slowly'),
    ('nonlinear_unexplained', true, 'Nonlinear, but no known effect explains it'),
    ('unexplained', true, 'Structured, but no known effect explains it'),
    ('not_controlling', false, 'No controller acts: manual, tracking, out of service, constant output'),
    ('insufficient_data', false, 'The data cannot be judged')
  ) AS kind (code, is_fault, meaning)
  LEFT JOIN loopscope.parameter ON parameter.name = 'weight_' || kind.code;

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
         1 - coalesce(analysis.combined_probabilities[1], verdict.cause_probabilities[1])::double precision AS fault_probability,
         loop.area, loop.unit, loop.description, loop.pv_unit, loop.owner,
         analysis.control_fraction, analysis.control_lost_by, analysis.control_lost_at,
         (SELECT max(windows) FROM unnest(analysis.combined_windows) AS windows)::double precision AS windows_together
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

COMMENT ON COLUMN loopscope.latest_verdict.windows_together IS 'As many windows that share no sample stand behind combined_probabilities; null = they were not combined';

-- A slot in which no controller acted says as little of a fault as one that could not be judged.
CREATE OR REPLACE FUNCTION loopscope.verdict_run(of_loop bigint, newest_slot timestamptz, of_code text)
RETURNS TABLE (since timestamptz, confirmed boolean) LANGUAGE sql STABLE
BEGIN ATOMIC
  -- The key's index, which holds the code, is read in order up to the row that decides; revisions are asked of few rows.
  WITH other AS (
    SELECT given.slot_end FROM loopscope.verdict AS given
    WHERE given.loop_id = of_loop AND given.slot_end < newest_slot AND given.code <> of_code AND given.code NOT IN ('insufficient_data', 'not_controlling')
      AND (SELECT newest.code FROM loopscope.verdict AS newest
           WHERE newest.loop_id = of_loop AND newest.slot_end = given.slot_end
           ORDER BY newest.algorithm_revision DESC, newest.input_revision DESC LIMIT 1) NOT IN (of_code, 'insufficient_data', 'not_controlling')
    ORDER BY given.slot_end DESC LIMIT 1
  ), first AS (
    SELECT given.slot_end FROM loopscope.verdict AS given
    WHERE given.loop_id = of_loop AND given.slot_end <= newest_slot AND given.code = of_code
      AND given.slot_end > coalesce((SELECT slot_end FROM other), '-infinity')
      AND (SELECT newest.code FROM loopscope.verdict AS newest
           WHERE newest.loop_id = of_loop AND newest.slot_end = given.slot_end
           ORDER BY newest.algorithm_revision DESC, newest.input_revision DESC LIMIT 1) = of_code
    ORDER BY given.slot_end LIMIT 1
  )
  SELECT first.slot_end,
         -- window_end is the last sample of a window, window_start the first.
         coalesce((SELECT newest.window_start FROM loopscope.analysis AS newest WHERE newest.loop_id = of_loop AND newest.slot_end = newest_slot
                   ORDER BY newest.algorithm_revision DESC LIMIT 1)
                  > (SELECT oldest.window_end FROM loopscope.analysis AS oldest WHERE oldest.loop_id = of_loop AND oldest.slot_end = first.slot_end
                     ORDER BY oldest.algorithm_revision DESC LIMIT 1), false)
  FROM first;
END;

-- What plants look at first: whether their controllers are in service at all.
CREATE VIEW loopscope.service_factor AS
  SELECT latest.loop_id, latest.loop_name, latest.area, latest.unit, latest.description, latest.owner, latest.source, latest.loop_type, latest.importance,
         latest.code <> 'not_controlling' AS controlling, latest.control_fraction, week.fraction AS week_fraction,
         CASE WHEN latest.control_lost_at IS NOT NULL THEN latest.control_lost_by END AS lost_by,
         CASE WHEN latest.control_lost_at IS NOT NULL THEN coalesce(lost.since, latest.control_lost_at) END AS lost_since,
         latest.slot_end
  FROM loopscope.latest_verdict AS latest
  CROSS JOIN LATERAL (
    SELECT avg(past.control_fraction) AS fraction FROM loopscope.analysis AS past
    WHERE past.loop_id = latest.loop_id AND past.slot_end > latest.slot_end - interval '7 days' AND past.slot_end <= latest.slot_end) AS week
  CROSS JOIN LATERAL (  -- the newest window that shows its beginning, or the first behind the last one at whose end a controller acted
    SELECT coalesce(max(past.control_lost_at) FILTER (WHERE past.control_lost_at > past.window_start), min(past.control_lost_at)) AS since
    FROM loopscope.analysis AS past
    WHERE latest.control_lost_at IS NOT NULL AND past.loop_id = latest.loop_id AND past.slot_end <= latest.slot_end
      AND past.slot_end > latest.slot_end - interval '90 days' AND past.control_lost_at IS NOT NULL
      AND past.slot_end > coalesce((
        SELECT max(acting.slot_end) FROM loopscope.analysis AS acting
        WHERE acting.loop_id = latest.loop_id AND acting.slot_end < latest.slot_end AND acting.slot_end > latest.slot_end - interval '90 days'
          AND acting.control_fraction IS NOT NULL AND acting.control_lost_at IS NULL), '-infinity')) AS lost
  WHERE latest.enabled AND (latest.control_fraction IS NOT NULL OR latest.code = 'not_controlling');
COMMENT ON VIEW loopscope.service_factor IS 'One row per enabled loop whose mode or output is recorded: whether a controller acts on it, for which share of the time, since when not. The mean of week_fraction over an area is its service factor';
COMMENT ON COLUMN loopscope.service_factor.controlling IS 'false: for most of the newest window no controller acted (verdict not_controlling)';
COMMENT ON COLUMN loopscope.service_factor.week_fraction IS 'Mean share over the windows of the last seven days';
COMMENT ON COLUMN loopscope.service_factor.lost_by IS 'Where none acts at the window''s end, what says so: mode or constant_output; null = one acts';
COMMENT ON COLUMN loopscope.service_factor.lost_since IS 'Since when, as far as the last 90 days of windows show; null = one acts';

INSERT INTO loopscope.data_problem_kind (code, role, shown, words, remedy) VALUES
  ('pv_dead', 'pv', false, 'pv stands still up to the end of the window', ''),
  ('not_controlling', 'mode', true, 'No controller acts', 'Nothing, if it is meant to be so; else put the controller in automatic'),
  ('op_range_inferred', 'op', false, 'The range of op was inferred from its values', 'Set op_low and op_high in the catalogue (loopscope loops check proposes them)'),
  ('op_range_doubted', 'op', true, 'The range of op in the catalogue cannot be right', 'Correct op_low and op_high in the catalogue (loopscope loops check proposes them)');
UPDATE loopscope.data_problem_kind SET words = 'pv stands still although it should not', remedy = 'Compare with a second measurement; check transmitter and archive; out of service if the process stands' WHERE code = 'pv_frozen';
UPDATE loopscope.data_problem_kind SET remedy = 'Correct what the reason names; see the other problems of the loop' WHERE code = 'insufficient_data';
UPDATE loopscope.data_problem_kind SET remedy = 'Nothing, if it is meant to be so' WHERE code = 'manual_mode';

CREATE OR REPLACE VIEW loopscope.data_problem AS
  SELECT latest.loop_id, latest.loop_name, latest.source, problem.role,
         CASE problem.role WHEN 'sp' THEN loop.sp_tag WHEN 'pv' THEN loop.pv_tag WHEN 'op' THEN loop.op_tag
                           WHEN 'mv' THEN loop.mv_tag WHEN 'mode' THEN loop.mode_tag END AS tag,
         problem.code AS problem, problem.words, problem.remedy, latest.code NOT IN ('insufficient_data', 'not_controlling') AS judged,
         problem.since, problem.slots, problem.last_row, problem.figure, latest.slot_end, latest.area, latest.unit, latest.owner
  FROM loopscope.latest_verdict AS latest
  JOIN loopscope.loop USING (loop_id)
  JOIN loopscope.schedule USING (loop_id)
  CROSS JOIN LATERAL (
    -- What the analysis itself says ...
    SELECT said.code,
           CASE WHEN said.code = 'not_controlling' AND latest.control_lost_by = 'constant_output' THEN 'op' ELSE kind.role END AS role,
           CASE said.code
             WHEN 'insufficient_data' THEN kind.words || ': ' || measured.unusable_reason
             WHEN 'op_range_doubted' THEN kind.words || ': ' || measured.op_range_doubt
             WHEN 'not_controlling' THEN CASE latest.control_lost_by WHEN 'mode' THEN 'In manual, tracking or out of service' ELSE 'The output is constant: in manual or out of service?' END
               || coalesce(', since ' || to_char(service.lost_since AT TIME ZONE 'UTC', 'YYYY-MM-DD HH24:MI "UTC"'), '')
             ELSE coalesce(kind.words, replace(said.code, '_', ' ')) END AS words,
           -- A young loop is short of nothing but time.
           CASE WHEN said.code = 'insufficient_data' AND measured.samples < wanted.samples AND measured.interval_s > 0 AND coalesce(measured.missing_fraction, 0) < 0.1
                THEN 'Wait: ' || wanted.samples || ' samples will be there at '
                     || to_char((measured.window_end + (wanted.samples - measured.samples) * measured.interval_s * interval '1 second') AT TIME ZONE 'UTC', 'YYYY-MM-DD HH24:MI "UTC"')
                ELSE coalesce(kind.remedy, '') END AS remedy,
           CASE WHEN said.code = 'not_controlling' THEN coalesce(service.lost_since, standing.first_slot, latest.slot_end)
                ELSE coalesce(standing.first_slot, latest.slot_end) END AS since, coalesce(standing.slots, 1) AS slots,
           standing.last_row, standing.figure
    FROM (SELECT usable, unusable_reason, flags, samples, interval_s, missing_fraction, window_end, op_range_doubt, settings FROM loopscope.analysis
          WHERE analysis.loop_id = latest.loop_id AND analysis.slot_end = latest.slot_end
            AND analysis.algorithm_revision = latest.algorithm_revision LIMIT 1) AS measured
    CROSS JOIN LATERAL (SELECT coalesce((measured.settings #>> '{analysis,min_usable_samples}')::bigint, 512) AS samples) AS wanted
    CROSS JOIN LATERAL (
      SELECT flag AS code FROM unnest(measured.flags) AS flag
      UNION ALL SELECT latest.code WHERE latest.code IN ('insufficient_data', 'not_controlling')) AS said
    LEFT JOIN LATERAL (
      SELECT lost_since FROM loopscope.service_factor AS factor
      WHERE said.code = 'not_controlling' AND factor.loop_id = latest.loop_id) AS service ON true
    LEFT JOIN loopscope.data_problem_kind AS kind ON kind.code = said.code
    LEFT JOIN loopscope.standing_problem AS standing
      ON standing.loop_id = latest.loop_id AND standing.code = said.code AND standing.role = ''
     AND standing.last_slot = latest.slot_end
    WHERE coalesce(kind.shown, true)
    UNION ALL
    -- ... and what the monitor saw on the tags.
    SELECT standing.code, standing.role, coalesce(kind.words, replace(standing.code, '_', ' ')),
           coalesce(kind.remedy, ''), coalesce(standing.last_row, standing.first_slot), standing.slots,
           standing.last_row, standing.figure
    FROM loopscope.standing_problem AS standing
    LEFT JOIN loopscope.data_problem_kind AS kind ON kind.code = standing.code
    WHERE standing.loop_id = latest.loop_id AND standing.role <> '' AND standing.last_slot = schedule.last_slot_end
      AND coalesce(kind.shown, true)
  ) AS problem
  WHERE latest.enabled;
COMMENT ON COLUMN loopscope.data_problem.judged IS 'Whether the loop could be judged all the same';

CREATE OR REPLACE VIEW loopscope.monitor_health AS
  WITH health AS (
    SELECT loop.loop_id, loop.name AS loop_name, loop.source, loop.enabled, loop.period_s,
           schedule.last_slot_end,
           extract(epoch FROM now() - schedule.last_slot_end)::double precision AS age_s,
           schedule.attempts AS failures, schedule.last_error,
           CASE WHEN loop.enabled
                THEN greatest(extract(epoch FROM now() - schedule.visible_at), 0)::double precision END AS overdue_s,
           schedule.owner, schedule.owner IS NOT NULL AND schedule.visible_at > now() AS leased,
           loop.enabled AND schedule.last_slot_end IS NULL AS never_analysed,
           latest.code = 'insufficient_data' AS dead_data,
           dead.tags AS dead_tags, dead.roles AS dead_roles, dead.since AS dead_since
    FROM loopscope.loop
    JOIN loopscope.schedule USING (loop_id)
    LEFT JOIN loopscope.latest_verdict AS latest USING (loop_id)
    LEFT JOIN LATERAL (
      SELECT array_agg(stopped.tag ORDER BY stopped.role) AS tags, array_agg(stopped.role ORDER BY stopped.role) AS roles,
             array_agg(stopped.since ORDER BY stopped.role) AS since
      FROM (SELECT standing.role, coalesce(standing.last_row, standing.first_slot) AS since,
                   CASE standing.role WHEN 'sp' THEN loop.sp_tag WHEN 'pv' THEN loop.pv_tag WHEN 'op' THEN loop.op_tag
                                      WHEN 'mv' THEN loop.mv_tag WHEN 'mode' THEN loop.mode_tag END AS tag
            FROM loopscope.standing_problem AS standing
            WHERE standing.loop_id = loop.loop_id AND standing.code IN ('dead_tag', 'no_rows')
              AND standing.last_slot = schedule.last_slot_end) AS stopped
    ) AS dead ON true
  )
  SELECT CASE WHEN NOT enabled THEN 'disabled'
              WHEN failures > 0 THEN 'failing'
              WHEN overdue_s > period_s THEN 'overdue'
              WHEN never_analysed THEN 'never_analysed'
              WHEN dead_data THEN 'dead_data'
              WHEN dead_tags IS NOT NULL THEN 'dead_tag'
              ELSE 'ok' END AS state,
         health.*
  FROM health;

-- Another tag is another signal.
CREATE FUNCTION loopscope.forget_pv() RETURNS trigger LANGUAGE plpgsql SET search_path = pg_catalog AS $$
BEGIN
  UPDATE loopscope.schedule SET pv_flat_s = NULL, pv_step = NULL WHERE loop_id = NEW.loop_id;
  RETURN NULL;
END $$;
COMMENT ON FUNCTION loopscope.forget_pv() IS 'Forgets what is known of pv where a loop gets another pv tag';
CREATE TRIGGER forget_pv AFTER UPDATE OF pv_tag, source ON loopscope.loop FOR EACH ROW
  WHEN (OLD.pv_tag <> NEW.pv_tag OR OLD.source <> NEW.source) EXECUTE FUNCTION loopscope.forget_pv();

ALTER FUNCTION loopscope.grant_rights() RENAME TO grant_rights_of_0017;
CREATE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
BEGIN
  PERFORM loopscope.grant_rights_of_0017();
  IF to_regrole('loopscope_worker') IS NOT NULL THEN
    GRANT UPDATE (pv_flat_s, pv_step) ON loopscope.schedule TO loopscope_worker;
  END IF;
END $$;
COMMENT ON FUNCTION loopscope.grant_rights_of_0017() IS 'The part of grant_rights() that stood before the schedule kept what a window tells the next';
COMMENT ON FUNCTION loopscope.grant_rights() IS 'Gives loopscope_worker, loopscope_reader and loopscope_engineer, where they exist, exactly the rights that they need, and takes every other one back';

-- As in 0022: a column that is named like an older one means the same.
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
    WHERE class.oid = ANY ('{loopscope.latest_verdict,loopscope.service_factor,loopscope.data_problem}'::regclass[]) AND col_description(class.oid, shown.attnum) IS NULL
    ORDER BY class.oid, shown.attnum, origin.priority
  LOOP
    EXECUTE format('COMMENT ON COLUMN loopscope.%I.%I IS %L', missing.relname, missing.attname, missing.words);
  END LOOP;
END $$;
