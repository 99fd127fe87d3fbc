-- In whose name people speak, and how often loops came onto the list.

-- The author is the login, which the server notes. Where several people share one, or a program speaks for them, the
-- row says for whom: one line of printable text that steers neither a terminal nor the direction of writing.
ALTER TABLE loopscope.annotation
  ADD COLUMN on_behalf_of text,
  ADD COLUMN withdrawn_on_behalf_of text,
  ADD CONSTRAINT annotation_on_behalf_of_check CHECK (
    char_length(on_behalf_of) BETWEEN 1 AND 200 AND on_behalf_of = btrim(on_behalf_of)
    AND on_behalf_of !~ '[\u0001-\u001f\u007f-\u009f\u061c\u180e\u200b\u200e\u200f\u2028-\u202e\u2060-\u206f]'
    AND on_behalf_of !~ '[\ufeff\ufff9-\ufffb\ufffe\uffff\U000e0000-\U000e0fff]'),
  ADD CONSTRAINT annotation_withdrawn_on_behalf_of_check CHECK (
    char_length(withdrawn_on_behalf_of) BETWEEN 1 AND 200 AND withdrawn_on_behalf_of = btrim(withdrawn_on_behalf_of)
    AND withdrawn_on_behalf_of !~ '[\u0001-\u001f\u007f-\u009f\u061c\u180e\u200b\u200e\u200f\u2028-\u202e\u2060-\u206f]'
    AND withdrawn_on_behalf_of !~ '[\ufeff\ufff9-\ufffb\ufffe\uffff\U000e0000-\U000e0fff]');
ALTER TABLE loopscope.maintenance_event
  ADD COLUMN on_behalf_of text,
  ADD CONSTRAINT maintenance_event_on_behalf_of_check CHECK (
    char_length(on_behalf_of) BETWEEN 1 AND 200 AND on_behalf_of = btrim(on_behalf_of)
    AND on_behalf_of !~ '[\u0001-\u001f\u007f-\u009f\u061c\u180e\u200b\u200e\u200f\u2028-\u202e\u2060-\u206f]'
    AND on_behalf_of !~ '[\ufeff\ufff9-\ufffb\ufffe\uffff\U000e0000-\U000e0fff]');
COMMENT ON COLUMN loopscope.annotation.author IS 'Login that entered it, as the server notes it';
COMMENT ON COLUMN loopscope.annotation.on_behalf_of IS
  'In whose name, as the author says: the server does not check it; null = in the author''s own';
COMMENT ON COLUMN loopscope.annotation.withdrawn_by IS
  'Login that took it back, as the server notes it; null = it holds, or was taken back before this was noted';
COMMENT ON COLUMN loopscope.annotation.withdrawn_on_behalf_of IS
  'In whose name it was taken back, as withdrawn_by says; null = it holds, or was in their own';
COMMENT ON COLUMN loopscope.annotation.until IS
  'When it ends to hold; null = when it is withdrawn; an acknowledged fault also when work that was done since is '
  'entered and a window lies wholly after it';
COMMENT ON COLUMN loopscope.maintenance_event.author IS 'Login that entered it, as the server notes it';
COMMENT ON COLUMN loopscope.maintenance_event.on_behalf_of IS
  'In whose name, as the author says: the server does not check it; null = in the author''s own';

-- An annotation is taken back once; by which login and when the server says, for whom the one who does it.
CREATE OR REPLACE FUNCTION loopscope.note_withdrawal() RETURNS trigger LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
BEGIN
  IF TG_OP = 'INSERT' THEN  -- as withdrawn already: the owner alone may, who brings in what was said elsewhere
    NEW.withdrawn_by := CASE WHEN NEW.withdrawn_at IS NOT NULL THEN coalesce(NEW.withdrawn_by, session_user) END;
  ELSIF OLD.withdrawn_at IS NOT NULL THEN
    RAISE EXCEPTION 'annotation % was taken back already', OLD.annotation_id USING ERRCODE = 'check_violation',
      DETAIL = format('by %s at %s', coalesce(OLD.withdrawn_by, 'somebody'), OLD.withdrawn_at),
      HINT = 'what is to hold again is said in a new annotation';
  ELSIF NEW.withdrawn_at IS NOT NULL THEN
    NEW.withdrawn_at := clock_timestamp();
    NEW.withdrawn_by := session_user;
  END IF;
  IF NEW.withdrawn_at IS NULL THEN
    NEW.withdrawn_on_behalf_of := NULL;
  END IF;
  RETURN NEW;
END $$;
CREATE OR REPLACE TRIGGER note_withdrawal BEFORE INSERT OR UPDATE OF withdrawn_at, withdrawn_on_behalf_of
  ON loopscope.annotation FOR EACH ROW EXECUTE FUNCTION loopscope.note_withdrawal();

CREATE OR REPLACE VIEW loopscope.annotation_history AS
  SELECT annotation_id, loop_id, loop.name AS loop_name, kind, code, until, reason, author, entered_at,
         withdrawn_at, withdrawn_by,
         CASE WHEN withdrawn_at IS NOT NULL THEN 'withdrawn' WHEN until <= now() THEN 'ended'
              -- The work that was planned is done, and a window that lies after it was looked at.
              WHEN kind = 'acknowledged' AND EXISTS (
                SELECT FROM loopscope.maintenance_event AS work JOIN loopscope.analysis AS newer USING (loop_id)
                WHERE work.loop_id = annotation.loop_id AND work.done_at > annotation.entered_at
                  AND newer.slot_end > work.done_at AND newer.window_start >= work.done_at) THEN 'ended'
              ELSE 'in_force' END AS state,
         on_behalf_of, withdrawn_on_behalf_of
  FROM loopscope.annotation JOIN loopscope.loop USING (loop_id);
COMMENT ON COLUMN loopscope.annotation_history.until IS
  'When it ends; null = when it is withdrawn; an acknowledged fault also when work that was done since is entered and '
  'a window lies wholly after it; a victim with the next plant round';
COMMENT ON COLUMN loopscope.annotation_history.author IS 'Login that entered it; null = the program';
COMMENT ON COLUMN loopscope.annotation_history.on_behalf_of IS
  'In whose name, as the author says; null = in the author''s own';
COMMENT ON COLUMN loopscope.annotation_history.withdrawn_on_behalf_of IS
  'In whose name it was taken back, as withdrawn_by says; null = it holds, or was in their own';

CREATE OR REPLACE VIEW loopscope.annotation_in_force AS
  SELECT annotation_id, loop_id, loop_name, kind, code, until, reason, author, entered_at, on_behalf_of
  FROM loopscope.annotation_history WHERE state = 'in_force';

CREATE OR REPLACE VIEW loopscope.hiding AS
  SELECT loop_id, kind AS hidden_by, code, NULL::timestamptz AS last_slot, annotation_id, until, reason, author,
         entered_at, NULL::integer AS plant_oscillation_number, NULL::text AS source_loop_name, on_behalf_of
  FROM loopscope.annotation_in_force
  UNION ALL
  SELECT member.loop_id, 'victim', NULL, current.holds_until, NULL, NULL, current.statement, NULL, current.found_at,
         current.number, current.source_loop_name, NULL
  FROM loopscope.current_plant_oscillation AS current
  CROSS JOIN LATERAL unnest(current.loop_ids, current.roles) AS member (loop_id, role)
  -- The other loop of a cascade is a victim too. Whoever causes one oscillation is not excused by being the victim of
  -- another.
  WHERE member.role IN ('victim', 'cascade_slave', 'cascade_master')
    AND member.loop_id NOT IN (SELECT source_loop_id FROM loopscope.current_plant_oscillation
                               WHERE source_loop_id IS NOT NULL)
    -- Whoever calls what was found of the source false wants to see the others again.
    AND NOT EXISTS (SELECT FROM loopscope.annotation_in_force AS said
                    JOIN loopscope.own_verdict AS latest USING (loop_id)
                    WHERE said.loop_id = current.source_loop_id AND said.kind = 'false_positive'
                      AND coalesce(said.code, latest.code) = latest.code);
COMMENT ON COLUMN loopscope.hiding.on_behalf_of IS 'In whose name, as the author says; null = in the author''s own';

-- In plain words what keeps a loop off the list, and what will decide. The newest verdict is told as the cause only
-- where it is probable enough.
CREATE OR REPLACE VIEW loopscope.hidden_loop AS
  WITH question AS MATERIALIZED (SELECT * FROM loopscope.list_questions()),
  likeliest AS (  -- of the causes behind healthy, whatever the verdict
    SELECT latest.loop_id, cause.name, cause.probability
    FROM loopscope.own_verdict AS latest CROSS JOIN loopscope.parameter AS least
    CROSS JOIN LATERAL (
      SELECT weighed.name, weighed.probability::double precision
      FROM unnest('{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,'
                  'process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,'
                  'nonlinear_unexplained}'::text[],
                  coalesce(latest.combined_probabilities, latest.cause_probabilities)) AS weighed (name, probability)
      WHERE weighed.name <> 'healthy' AND weighed.probability IS NOT NULL
      ORDER BY weighed.name = latest.code AND weighed.probability >= least.value DESC, weighed.probability DESC
      LIMIT 1) AS cause
    WHERE least.name = 'min_confidence'
    UNION ALL
    SELECT latest.loop_id, latest.code, latest.confidence FROM loopscope.own_verdict AS latest
    WHERE coalesce(latest.combined_probabilities, latest.cause_probabilities) IS NULL
  ), held AS (
    SELECT latest.loop_id, hiding.hidden_by, hiding.until, hiding.reason, hiding.author, hiding.entered_at,
           hiding.annotation_id, hiding.plant_oscillation_number, hiding.source_loop_name, hiding.on_behalf_of
    FROM loopscope.hiding
    JOIN loopscope.own_verdict AS latest USING (loop_id)
    JOIN question USING (loop_id)
    JOIN loopscope.verdict_kind AS kind ON kind.code = question.shown_code
    WHERE kind.is_fault AND (hiding.code IS NULL OR hiding.code = question.shown_code)
      AND (hiding.last_slot IS NULL OR latest.slot_end <= hiding.last_slot)
  ), unlisted AS (
    SELECT question.loop_id,
           CASE WHEN is_common THEN 'chance' ELSE 'probability' END AS hidden_by,
           CASE WHEN NOT is_common
                THEN 'not sure enough for the list (probability '
                     || round(coalesce(question.fault_probability, likeliest.probability)::numeric, 2) || ')'
                     || CASE WHEN question.fault_probability >= list_least.value
                             THEN ': with the surer ones, more than '
                                  || round((100 * list_false.value)::numeric, 1)::float8
                                  || ' % of the list would be no fault'
                             ELSE '' END
                WHEN question.loop_p >= 1
                THEN 'no test of this window shows it: its probability alone decides once more windows have been read'
                ELSE 'as strong evidence is found by chance too often among so many loops (p '
                     || trim(to_char(question.loop_p, '9.9EEEE'))
                     || coalesce(', at most ' || trim(to_char(question.bound, '9.9EEEE')) || ' would do', '')
                     || '): its probability alone decides once more windows have been read' END AS reason
    FROM question JOIN likeliest USING (loop_id)
    JOIN loopscope.parameter AS list_least ON list_least.name = 'list_least_probability'
    JOIN loopscope.parameter AS list_false ON list_false.name = 'list_false_share'
    CROSS JOIN LATERAL (
      SELECT NOT question.rare AND question.is_fault AND question.within_share
             AND coalesce(question.fault_probability, 1) >= list_least.value AS is_common) AS by_chance
    JOIN loopscope.parameter AS least ON least.name = 'min_confidence'
    WHERE NOT question.enters AND NOT question.stays AND likeliest.probability >= least.value
      AND likeliest.name NOT IN ('healthy', 'not_controlling', 'insufficient_data')
      AND question.loop_id NOT IN (SELECT loop_id FROM held)
  ), hidden AS (
    SELECT * FROM held
    UNION ALL
    SELECT loop_id, hidden_by, NULL, reason, NULL, NULL, NULL, NULL, NULL, NULL FROM unlisted
  )
  SELECT latest.loop_id, latest.loop_name, latest.code, latest.confidence, latest.slot_end, latest.summary,
         hidden.hidden_by, hidden.until, hidden.reason, hidden.author, hidden.entered_at, hidden.annotation_id,
         hidden.plant_oscillation_number, hidden.source_loop_name,
         likeliest.name AS cause, likeliest.probability, latest.area, latest.unit, latest.description, latest.owner,
         hidden.on_behalf_of
  FROM hidden
  JOIN loopscope.own_verdict AS latest USING (loop_id)
  LEFT JOIN likeliest USING (loop_id)
  WHERE latest.enabled;
COMMENT ON COLUMN loopscope.hidden_loop.on_behalf_of IS
  'In whose name, as the author says; null = in the author''s own, or no annotation';

CREATE OR REPLACE VIEW loopscope.before_after_maintenance AS
  SELECT work.maintenance_event_id, work.loop_id, loop.name AS loop_name, work.done_at, work.kind,
         work.description, before.slot_end AS slot_end_before, after.slot_end AS slot_end_after,
         before.code AS code_before, after.code AS code_after,
         before.error_std AS error_std_before, after.error_std AS error_std_after,
         after.error_std / nullif(before.error_std, 0) AS error_std_ratio,
         before.harris_low AS harris_low_before, after.harris_low AS harris_low_after,
         before.ngi AS ngi_before, after.ngi AS ngi_after,
         before.nli AS nli_before, after.nli AS nli_after,
         before.oscillation_period_s AS oscillation_period_s_before,
         after.oscillation_period_s AS oscillation_period_s_after,
         before.valve_travel_per_h AS valve_travel_per_h_before,
         after.valve_travel_per_h AS valve_travel_per_h_after,
         judged.word,
         coalesce(judged.statement, 'Not judged yet: a running service judges it with its next comparison, '
                                    'a single pass (once) at its end.') AS statement,
         judged.windows_before, judged.windows_after,
         judged.fault_before, judged.fault_after, judged.variance_ratio,
         judged.variance_ratio_low, judged.variance_ratio_high, judged.figures,
         work.author, work.entered_at, work.on_behalf_of
  FROM loopscope.maintenance_event AS work
  JOIN loopscope.loop USING (loop_id)
  LEFT JOIN loopscope.repair_judgement AS judged USING (maintenance_event_id)
  -- Windows that lie wholly between two jobs: one that straddles them mixes both states.
  CROSS JOIN LATERAL (
    SELECT begins_at, ends_at, coalesce(previous_at, '-infinity') AS previous_at,
           coalesce(next_at, 'infinity') AS next_at
    FROM loopscope.maintenance_job AS job
    WHERE job.maintenance_event_id = work.maintenance_event_id) AS span
  LEFT JOIN LATERAL (
    SELECT code, analysis.* FROM loopscope.analysis
    JOIN loopscope.verdict USING (loop_id, slot_end, algorithm_revision, input_revision)
    WHERE analysis.loop_id = work.loop_id AND analysis.slot_end <= span.begins_at
      AND analysis.window_start >= span.previous_at AND analysis.usable
    ORDER BY analysis.slot_end DESC, analysis.algorithm_revision DESC LIMIT 1) AS before ON true
  LEFT JOIN LATERAL (
    SELECT code, analysis.* FROM loopscope.analysis
    JOIN loopscope.verdict USING (loop_id, slot_end, algorithm_revision, input_revision)
    WHERE analysis.loop_id = work.loop_id AND analysis.slot_end > span.ends_at
      AND analysis.slot_end <= span.next_at AND analysis.window_start >= span.ends_at
      AND analysis.usable
    ORDER BY analysis.slot_end DESC, analysis.algorithm_revision DESC LIMIT 1) AS after ON true;
COMMENT ON COLUMN loopscope.before_after_maintenance.author IS 'Login that entered it, as the server notes it';
COMMENT ON COLUMN loopscope.before_after_maintenance.entered_at IS 'When it was entered';
COMMENT ON COLUMN loopscope.before_after_maintenance.on_behalf_of IS
  'In whose name, as the author says; null = in the author''s own';
COMMENT ON COLUMN loopscope.annotation_in_force.until IS
  'When it ends; null = when it is withdrawn; an acknowledged fault also when work that was done since is entered and '
  'a window lies wholly after it';
COMMENT ON COLUMN loopscope.annotation_in_force.author IS 'Login that entered it, as the server notes it';
COMMENT ON COLUMN loopscope.annotation_in_force.on_behalf_of IS
  'In whose name, as the author says; null = in the author''s own';

-- Stays are deleted with their age and with their loop; what alarms are made of must not go back. A trigger counts, so
-- that a program of before does too.
CREATE TABLE loopscope.flag_total (
  code      text PRIMARY KEY,
  announced bigint NOT NULL CHECK (announced >= 0)
);
COMMENT ON TABLE loopscope.flag_total IS
  'How often a loop came onto the list with a verdict and listeners were told, since the beginning: only ever more';
COMMENT ON COLUMN loopscope.flag_total.code IS 'The verdict that loops were flagged with';
COMMENT ON COLUMN loopscope.flag_total.announced IS 'Times; those not told of (flag_notice.announced) do not count';
INSERT INTO loopscope.flag_total (code, announced)
  SELECT code, count(*) FROM loopscope.flag_notice WHERE announced GROUP BY code;

CREATE OR REPLACE FUNCTION loopscope.count_flags() RETURNS trigger LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
BEGIN
  INSERT INTO loopscope.flag_total AS total (code, announced)
    SELECT code, count(*) FROM added WHERE announced GROUP BY code ORDER BY code
    ON CONFLICT (code) DO UPDATE SET announced = total.announced + excluded.announced;
  RETURN NULL;
END $$;
COMMENT ON FUNCTION loopscope.count_flags() IS 'Adds announced stays to flag_total';
CREATE OR REPLACE TRIGGER count_flags AFTER INSERT ON loopscope.flag_notice
  REFERENCING NEW TABLE AS added FOR EACH STATEMENT EXECUTE FUNCTION loopscope.count_flags();

-- Exactly these rights (storage/README.md, "Roles", is the list, and a test compares): `migrate` calls this every
-- time, so that a role that is created later gets its rights with the next call, and whatever else the groups were
-- given is taken back. Nobody sees the moment between, because it is one transaction. The worker's UPDATE leaves out
-- every key, so that no row of results can be passed off as another's, and holds no lock that stops readers.
CREATE OR REPLACE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
DECLARE
  grantee text;
  written record;
BEGIN
  FOREACH grantee IN ARRAY '{PUBLIC,loopscope_historian,loopscope_worker,loopscope_reader,loopscope_engineer}'::text[]
  LOOP
    CONTINUE WHEN grantee <> 'PUBLIC' AND to_regrole(grantee) IS NULL;
    EXECUTE 'REVOKE ALL ON SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL TABLES IN SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL SEQUENCES IN SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL FUNCTIONS IN SCHEMA loopscope FROM ' || grantee;
    CONTINUE WHEN grantee IN ('PUBLIC', 'loopscope_historian');
    EXECUTE 'GRANT USAGE ON SCHEMA loopscope TO ' || grantee;
    EXECUTE 'GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO ' || grantee;
    -- What views call is called with the rights of whoever asks.
    EXECUTE 'GRANT EXECUTE ON FUNCTION loopscope.verdict_run, loopscope.flagged_at, loopscope.list_questions, '
            'loopscope.last_fault, loopscope.oldest_program TO ' || grantee;
  END LOOP;
  IF to_regrole('loopscope_reader') IS NOT NULL THEN
    GRANT SELECT ON ALL SEQUENCES IN SCHEMA loopscope TO loopscope_reader;  -- for pg_dump
  END IF;
  IF to_regrole('loopscope_engineer') IS NOT NULL THEN
    -- Without author and entered_at: which login said it, and when, is the server's to note.
    GRANT INSERT (loop_id, kind, code, until, reason, on_behalf_of), UPDATE (withdrawn_at, withdrawn_on_behalf_of)
      ON loopscope.annotation TO loopscope_engineer;
    GRANT INSERT (loop_id, done_at, kind, description, on_behalf_of)
      ON loopscope.maintenance_event TO loopscope_engineer;
  END IF;
  IF to_regrole('loopscope_worker') IS NOT NULL THEN
    GRANT UPDATE (visible_at, owner, fence, attempts, lost_leases, last_error, last_slot_end, result_slot_end, hold_s,
                  pv_flat_s, pv_step) ON loopscope.schedule TO loopscope_worker;
    GRANT UPDATE (value) ON loopscope.parameter TO loopscope_worker;
    GRANT UPDATE (owner, until, hold_s) ON loopscope.task_lease TO loopscope_worker;
    GRANT UPDATE (status, confirmed_at, ended_at, ended_by) ON loopscope.flag_notice TO loopscope_worker;
    GRANT INSERT ON loopscope.analysis, loopscope.bicoherence_peak, loopscope.explanation_step, loopscope.verdict,
      loopscope.plant_oscillation, loopscope.plant_round, loopscope.standing_problem, loopscope.stage_cost,
      loopscope.worker, loopscope.flag_notice, loopscope.flag_total, loopscope.repair_judgement TO loopscope_worker;
    FOR written IN
      SELECT class.relname, string_agg(quote_ident(part.attname), ', ' ORDER BY part.attnum) AS columns
      FROM pg_class AS class
      JOIN pg_attribute AS part ON part.attrelid = class.oid AND part.attnum > 0 AND NOT part.attisdropped
      WHERE class.relnamespace = 'loopscope'::regnamespace
        AND class.relname IN ('analysis', 'plant_oscillation', 'plant_round', 'standing_problem', 'stage_cost',
                              'worker', 'repair_judgement', 'flag_total')
        AND part.attname <> 'analysis_id'
        AND NOT EXISTS (SELECT FROM pg_index AS key WHERE key.indrelid = class.oid AND key.indisprimary
                                                      AND part.attnum = ANY (key.indkey))
      GROUP BY class.relname
    LOOP
      EXECUTE format('GRANT UPDATE (%s) ON loopscope.%I TO loopscope_worker', written.columns, written.relname);
    END LOOP;
    GRANT USAGE ON SEQUENCE loopscope.analysis_id TO loopscope_worker;
  END IF;
END $$;
