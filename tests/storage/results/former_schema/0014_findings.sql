-- Working with findings: since when a verdict stands, whether a second window confirmed it, what hides one, who was told.

-- The views below ask for the code of every slot of a loop's past: with the code in the key's index
-- they read the index alone, where each row of the table would be on a page of its own.
ALTER TABLE loopscope.verdict DROP CONSTRAINT verdict_pkey;
ALTER TABLE loopscope.verdict
  ADD PRIMARY KEY (loop_id, slot_end, algorithm_revision, input_revision) INCLUDE (code);

INSERT INTO loopscope.parameter (name, value, unit, description) VALUES
  ('plant_round_valid_days', 7, 'days, > 0', 'A verdict that is so much newer than the newest plant round is not hidden by it'),
  ('flag_quiet_hours', 24, 'hours, >= 0', 'A loop that is flagged again so soon after the same flag ended is not announced again');
COMMENT ON TABLE loopscope.parameter IS 'Numbers that the views compute with; false_discovery_rate, false_discovery_dependence and min_confidence follow the settings file, the others are the site''s to change';

-- The run of a verdict. Late rows replace the verdict of a slot: its newest revision counts. A slot that could not be judged
-- says nothing, and so neither breaks a run nor belongs to it.
CREATE FUNCTION loopscope.verdict_run(of_loop bigint, newest_slot timestamptz, of_code text)
RETURNS TABLE (since timestamptz, confirmed boolean) LANGUAGE sql STABLE
BEGIN ATOMIC
  -- The key's index, which holds the code, is read in order up to the row that decides; revisions are asked of few rows.
  WITH other AS (
    SELECT given.slot_end FROM loopscope.verdict AS given
    WHERE given.loop_id = of_loop AND given.slot_end < newest_slot AND given.code <> of_code AND given.code <> 'insufficient_data'
      AND (SELECT newest.code FROM loopscope.verdict AS newest
           WHERE newest.loop_id = of_loop AND newest.slot_end = given.slot_end
           ORDER BY newest.algorithm_revision DESC, newest.input_revision DESC LIMIT 1) NOT IN (of_code, 'insufficient_data')
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
COMMENT ON FUNCTION loopscope.verdict_run(bigint, timestamptz, text) IS 'Of the verdict of_code that the loop has at newest_slot: the slot since which it was given without another one in between, and whether it is confirmed by a window that shares no sample with the first one of the run';

-- Oscillations that loops share, found in rounds: one that finds nothing supersedes the one before.
CREATE TABLE loopscope.plant_round (
  slot_end timestamptz, algorithm_revision integer, loops integer NOT NULL CHECK (loops >= 0),
  oscillating integer NOT NULL CHECK (oscillating >= 0), events integer NOT NULL CHECK (events >= 0),
  found_at timestamptz NOT NULL DEFAULT now(), PRIMARY KEY (slot_end, algorithm_revision));
COMMENT ON TABLE loopscope.plant_round IS 'Comparisons across all loops, one row each; the newest one holds';
COMMENT ON COLUMN loopscope.plant_round.loops IS 'Loops that were looked at'; COMMENT ON COLUMN loopscope.plant_round.oscillating IS 'Of those, loops that oscillate';
COMMENT ON COLUMN loopscope.plant_round.events IS 'Oscillations that several of them share: plant_oscillation has one row each, numbered from 1';

ALTER TABLE loopscope.plant_oscillation
  ADD COLUMN roles text[], ADD COLUMN scores double precision[], ADD COLUMN p double precision CHECK (p BETWEEN 0 AND 1),
  ADD CONSTRAINT plant_oscillation_roles CHECK (
    (roles IS NULL OR cardinality(roles) = cardinality(loop_ids))
    AND (scores IS NULL OR cardinality(scores) = cardinality(loop_ids))
    AND roles <@ ARRAY['source', 'victim', 'cascade_slave', 'cascade_master', 'member']);
COMMENT ON COLUMN loopscope.plant_oscillation.roles IS 'What each loop is to it, in the order of loop_ids: source, victim, cascade_slave, cascade_master or member (keeps its place on the list); null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation.scores IS 'How much speaks for each loop as the source, higher = more, in the order of loop_ids; null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation.p IS 'Chance that loops which have nothing to do with each other agree so well; null = not computed';

CREATE VIEW loopscope.newest_plant_round AS
  SELECT round.*, round.slot_end + parameter.value * interval '1 day' AS holds_until
  FROM (SELECT * FROM loopscope.plant_round ORDER BY slot_end DESC, algorithm_revision DESC LIMIT 1) AS round
  JOIN loopscope.parameter ON parameter.name = 'plant_round_valid_days';
COMMENT ON VIEW loopscope.newest_plant_round IS 'The comparison across all loops that holds: one row, none before the first one'; COMMENT ON COLUMN loopscope.newest_plant_round.holds_until IS 'Verdicts of later slots are not hidden by it (parameter plant_round_valid_days)';

CREATE VIEW loopscope.current_plant_oscillation AS
  SELECT oscillation.*, source.name AS source_loop_name, round.holds_until FROM loopscope.newest_plant_round AS round
  JOIN loopscope.plant_oscillation AS oscillation USING (slot_end, algorithm_revision)
  LEFT JOIN loopscope.loop AS source ON source.loop_id = oscillation.source_loop_id
  WHERE oscillation.number <= round.events;
COMMENT ON VIEW loopscope.current_plant_oscillation IS 'Oscillations that loops share, as the newest round found them: one row each';

CREATE OR REPLACE VIEW loopscope.plant_oscillation_member AS
  SELECT oscillation.slot_end, oscillation.algorithm_revision, oscillation.number, oscillation.period_s,
         loop.loop_id, loop.name AS loop_name, member.strength, member.lag_s,
         loop.loop_id IS NOT DISTINCT FROM oscillation.source_loop_id AS is_source, oscillation.statement,
         coalesce(member.role, CASE WHEN loop.loop_id = oscillation.source_loop_id THEN 'source' ELSE 'member' END) AS role,
         member.score, EXISTS (SELECT FROM loopscope.newest_plant_round AS newest WHERE (newest.slot_end, newest.algorithm_revision)
                                 = (oscillation.slot_end, oscillation.algorithm_revision)) AS is_current
  FROM loopscope.plant_oscillation AS oscillation
  LEFT JOIN loopscope.plant_round AS round USING (slot_end, algorithm_revision)
  CROSS JOIN LATERAL unnest(oscillation.loop_ids, oscillation.strengths, oscillation.lags_s, oscillation.roles, oscillation.scores)
    AS member (loop_id, strength, lag_s, role, score)
  JOIN loopscope.loop ON loop.loop_id = member.loop_id
  -- A round that was written again with fewer events has left the others behind.
  WHERE oscillation.number <= coalesce(round.events, oscillation.number);
COMMENT ON COLUMN loopscope.plant_oscillation_member.role IS 'What the loop is to it: source, victim, cascade_slave, cascade_master or member (keeps its place on the list)';
COMMENT ON COLUMN loopscope.plant_oscillation_member.score IS 'How much speaks for the loop as the source, higher = more; null = not said'; COMMENT ON COLUMN loopscope.plant_oscillation_member.is_current IS 'Whether it is of the newest round';

-- What people said: who took it back stands beside who said it.
ALTER TABLE loopscope.annotation ADD COLUMN withdrawn_by text;
COMMENT ON COLUMN loopscope.annotation.withdrawn_by IS 'Who took it back; null = it holds, or was taken back before this was noted';

CREATE FUNCTION loopscope.note_withdrawal() RETURNS trigger LANGUAGE plpgsql SET search_path = pg_catalog AS $$
BEGIN NEW.withdrawn_by := CASE WHEN NEW.withdrawn_at IS NOT NULL THEN session_user END; RETURN NEW; END $$;
COMMENT ON FUNCTION loopscope.note_withdrawal() IS 'Notes who takes an annotation back';
CREATE TRIGGER note_withdrawal BEFORE INSERT OR UPDATE OF withdrawn_at ON loopscope.annotation FOR EACH ROW EXECUTE FUNCTION loopscope.note_withdrawal();

CREATE VIEW loopscope.annotation_history AS
  SELECT annotation_id, loop_id, loop.name AS loop_name, kind, code, until, reason, author, entered_at, withdrawn_at, withdrawn_by,
         CASE WHEN withdrawn_at IS NOT NULL THEN 'withdrawn' WHEN until <= now() THEN 'ended'
              -- The work that was planned is done, and a window that lies after it was looked at.
              WHEN kind = 'acknowledged' AND EXISTS (
                SELECT FROM loopscope.maintenance_event AS work JOIN loopscope.analysis AS newer USING (loop_id)
                WHERE work.loop_id = annotation.loop_id AND work.done_at > annotation.entered_at
                  AND newer.slot_end > work.done_at AND newer.window_start >= work.done_at) THEN 'ended'
              ELSE 'in_force' END AS state
  FROM loopscope.annotation JOIN loopscope.loop USING (loop_id);
COMMENT ON VIEW loopscope.annotation_history IS 'One row per annotation that was ever made: what was said of which loop, by whom, whether it still holds';
COMMENT ON COLUMN loopscope.annotation_history.state IS 'in_force, ended (its time is over; an acknowledged fault: work was done since, and a window lies after it) or withdrawn';

CREATE VIEW loopscope.annotation_in_force AS
  SELECT annotation_id, loop_id, loop_name, kind, code, until, reason, author, entered_at
  FROM loopscope.annotation_history WHERE state = 'in_force';
COMMENT ON VIEW loopscope.annotation_in_force IS 'Annotations that hold now';

-- Everything that keeps a fault from the list, whoever wants it so: this is the only place.
CREATE VIEW loopscope.hiding AS
  SELECT loop_id, kind AS hidden_by, code, NULL::timestamptz AS last_slot, annotation_id, until, reason, author, entered_at,
         NULL::integer AS plant_oscillation_number, NULL::text AS source_loop_name
  FROM loopscope.annotation_in_force
  UNION ALL
  SELECT member.loop_id, 'victim', NULL, current.holds_until, NULL, NULL, current.statement, NULL, current.found_at,
         current.number, current.source_loop_name
  FROM loopscope.current_plant_oscillation AS current
  CROSS JOIN LATERAL unnest(current.loop_ids, current.roles) AS member (loop_id, role)
  -- The other loop of a cascade is a victim too. Whoever causes one oscillation is not excused by being the victim of another.
  WHERE member.role IN ('victim', 'cascade_slave', 'cascade_master')
    AND member.loop_id NOT IN (SELECT source_loop_id FROM loopscope.current_plant_oscillation WHERE source_loop_id IS NOT NULL)
    -- Whoever calls what was found of the source false wants to see the others again.
    AND NOT EXISTS (SELECT FROM loopscope.annotation_in_force AS said JOIN loopscope.latest_verdict AS latest USING (loop_id)
                    WHERE said.loop_id = current.source_loop_id AND said.kind = 'false_positive' AND coalesce(said.code, latest.code) = latest.code);
COMMENT ON VIEW loopscope.hiding IS 'What hides verdicts from flagged_loop: annotations that hold, and being the victim of a shared oscillation; hidden_loop shows what is hidden by it';
COMMENT ON COLUMN loopscope.hiding.hidden_by IS 'acknowledged, suppressed, false_positive or victim'; COMMENT ON COLUMN loopscope.hiding.code IS 'Verdict that is hidden; null = whatever the verdict';
COMMENT ON COLUMN loopscope.hiding.last_slot IS 'Verdicts of later slots are not hidden; null = all are'; COMMENT ON COLUMN loopscope.hiding.annotation_id IS 'Number of the annotation; null = none, a victim';
COMMENT ON COLUMN loopscope.hiding.until IS 'When it ends; null = when it is withdrawn, or the next plant round'; COMMENT ON COLUMN loopscope.hiding.reason IS 'Why';
COMMENT ON COLUMN loopscope.hiding.author IS 'Who entered it; null = the program'; COMMENT ON COLUMN loopscope.hiding.plant_oscillation_number IS 'Oscillation that the loop is the victim of; null = an annotation';
COMMENT ON COLUMN loopscope.hiding.source_loop_name IS 'Loop that causes that oscillation; null = outside or unknown';

CREATE VIEW loopscope.hidden_loop AS
  SELECT latest.loop_id, latest.loop_name, latest.code, latest.confidence, latest.slot_end, latest.summary,
         hiding.hidden_by, hiding.until, hiding.reason, hiding.author, hiding.entered_at, hiding.annotation_id,
         hiding.plant_oscillation_number, hiding.source_loop_name
  FROM loopscope.hiding
  JOIN loopscope.latest_verdict AS latest USING (loop_id)
  JOIN loopscope.verdict_kind AS kind ON kind.code = latest.code
  WHERE latest.enabled AND kind.is_fault AND (hiding.code IS NULL OR hiding.code = latest.code)
    AND (hiding.last_slot IS NULL OR latest.slot_end <= hiding.last_slot);
COMMENT ON VIEW loopscope.hidden_loop IS 'One row per fault of an enabled loop and thing that keeps it from flagged_loop: what is hidden, by what or whom, why and until when';

-- The list, at any thresholds. The control is that of 0006, where it is argued; whatever hides a verdict hides it before the
-- control and leaves the family as large as it was. What is asked of flagged loops alone (since, status) comes last.
CREATE FUNCTION loopscope.flagged_at(rate float8 DEFAULT NULL, dependence float8 DEFAULT NULL, least_confidence float8 DEFAULT NULL)
RETURNS TABLE (
  rank bigint, loop_id bigint, loop_name text, source text, loop_type text, code text, score float8, severity float8,
  importance float8, kind_weight float8, confidence float8, p float8, false_discovery_threshold float8, nonlinear_p float8,
  slot_end timestamptz, algorithm_revision integer, input_revision integer, analysis_id bigint, summary text, reasons text[],
  action text, ngi float8, nli float8, oscillation_period_s float8, harris_low float8, harris_high float8,
  status text, since timestamptz, plant_oscillation_number integer) LANGUAGE sql STABLE
BEGIN ATOMIC
  WITH setting AS (
    SELECT coalesce(rate, max(value) FILTER (WHERE name = 'false_discovery_rate')) AS false_discovery_rate,
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
           kind.is_fault AND confidence >= setting.min_confidence AND NOT coalesce(held.whatever_the_code
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
  ), candidate AS (
    SELECT latest.*,
           -- What a perfect linear controller could win; the middle where the index is unknown.
           CASE WHEN harris_low IS NULL OR harris_high IS NULL THEN 0.5
                ELSE least(greatest(1 - (harris_low + harris_high) / 2, 0), 1) END AS severity,
           control.threshold AS false_discovery_threshold
    FROM latest CROSS JOIN control WHERE shown AND (p IS NULL OR p <= control.threshold)
  ), caused AS (
    SELECT source_loop_id, min(number) AS number, max(holds_until) AS holds_until
    FROM loopscope.current_plant_oscillation GROUP BY source_loop_id
  )
  SELECT row_number() OVER (ORDER BY severity * importance * kind_weight * confidence DESC, candidate.loop_id) AS rank,
         candidate.loop_id, loop_name, source, loop_type, code,
         severity * importance * kind_weight * confidence AS score,
         severity, importance, kind_weight, confidence, p, false_discovery_threshold, nonlinear_p,
         slot_end, algorithm_revision, input_revision, analysis_id, summary, reasons, action,
         ngi, nli, oscillation_period_s, harris_low, harris_high,
         CASE WHEN run.confirmed THEN 'confirmed' ELSE 'watch' END AS status, run.since, caused.number AS plant_oscillation_number
  FROM candidate
  CROSS JOIN LATERAL loopscope.verdict_run(candidate.loop_id, candidate.slot_end, candidate.code) AS run
  LEFT JOIN caused ON caused.source_loop_id = candidate.loop_id AND candidate.slot_end <= caused.holds_until
  ORDER BY rank;
END;
COMMENT ON FUNCTION loopscope.flagged_at(double precision, double precision, double precision) IS 'flagged_loop as it would be at other thresholds: false_discovery_rate, false_discovery_dependence, min_confidence; null = as they are set';

CREATE OR REPLACE VIEW loopscope.flagged_loop AS SELECT * FROM loopscope.flagged_at();
COMMENT ON VIEW loopscope.flagged_loop IS 'Loops that somebody should act on, worst first: faults of enabled loops that are facts or pass the false-discovery control, and are neither annotated away nor victims of a shared oscillation';
COMMENT ON COLUMN loopscope.flagged_loop.status IS 'watch = new; confirmed = the same verdict came in a second window that shares no sample with the first one of its run';
COMMENT ON COLUMN loopscope.flagged_loop.since IS 'Slot of the first verdict of the unbroken run of this code';
COMMENT ON COLUMN loopscope.flagged_loop.plant_oscillation_number IS 'Shared oscillation (current_plant_oscillation) that the loop is the source of; null = none';

-- Who was told of what, and the history of the list.
CREATE TABLE loopscope.flag_notice (
  flag_notice_id bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  loop_id bigint NOT NULL REFERENCES loopscope.loop ON DELETE CASCADE,
  code text NOT NULL, flagged_at timestamptz NOT NULL DEFAULT now(), announced boolean NOT NULL,
  slot_end timestamptz NOT NULL, since timestamptz NOT NULL, status text NOT NULL CHECK (status IN ('watch', 'confirmed')), confidence double precision NOT NULL,
  rank bigint NOT NULL, score double precision NOT NULL, summary text NOT NULL, confirmed_at timestamptz,
  ended_at timestamptz, ended_by text CHECK (ended_by IN ('verdict', 'annotation', 'plant', 'disabled', 'threshold')));
CREATE UNIQUE INDEX flag_notice_open ON loopscope.flag_notice (loop_id, code) WHERE ended_at IS NULL; CREATE INDEX flag_notice_of_loop ON loopscope.flag_notice (loop_id, flagged_at);
COMMENT ON TABLE loopscope.flag_notice IS 'History of flagged_loop: one row per stay of a loop on the list, noted by whoever announces newly flagged loops (NOTIFY loopscope_flagged)';
COMMENT ON COLUMN loopscope.flag_notice.flag_notice_id IS 'Number of the notice'; COMMENT ON COLUMN loopscope.flag_notice.code IS 'Verdict that it was flagged with';
COMMENT ON COLUMN loopscope.flag_notice.flagged_at IS 'When it was seen on the list first'; COMMENT ON COLUMN loopscope.flag_notice.announced IS 'Whether listeners were told; false = it had just left the list (parameter flag_quiet_hours)';
COMMENT ON COLUMN loopscope.flag_notice.slot_end IS 'Slot of the verdict that was flagged first'; COMMENT ON COLUMN loopscope.flag_notice.since IS 'Slot of the first verdict of the run at that time';
COMMENT ON COLUMN loopscope.flag_notice.status IS 'watch or confirmed, as it stands or stood last'; COMMENT ON COLUMN loopscope.flag_notice.confidence IS 'Confidence of that verdict, 0 to 1';
COMMENT ON COLUMN loopscope.flag_notice.rank IS 'Its rank at that time'; COMMENT ON COLUMN loopscope.flag_notice.score IS 'Its score at that time'; COMMENT ON COLUMN loopscope.flag_notice.summary IS 'What was said of it';
COMMENT ON COLUMN loopscope.flag_notice.confirmed_at IS 'When it was seen confirmed first; null = it was not yet';
COMMENT ON COLUMN loopscope.flag_notice.ended_at IS 'When it was found gone from the list; null = it stands'; COMMENT ON COLUMN loopscope.flag_notice.ended_by IS 'What ended it: verdict (another one), annotation, plant (found to be a victim), disabled, or threshold';

CREATE VIEW loopscope.flag_history AS
  SELECT flag_notice_id, loop_id, loop.name AS loop_name, code, flagged_at, since, status, confirmed_at, ended_at, ended_by,
         ended_at IS NULL AS stands, announced, slot_end, confidence, rank, score, summary
  FROM loopscope.flag_notice JOIN loopscope.loop USING (loop_id);
COMMENT ON VIEW loopscope.flag_history IS 'One row per stay of a loop on the list: when it came, as what, when and why it left'; COMMENT ON COLUMN loopscope.flag_history.stands IS 'Whether it is still flagged';

-- What 0012 gives stays; this adds to it. What views call is called with the rights of whoever asks.
ALTER FUNCTION loopscope.grant_rights() RENAME TO grant_rights_of_0012;
CREATE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
DECLARE grantee text;
BEGIN
  PERFORM loopscope.grant_rights_of_0012();
  IF to_regrole('loopscope_engineer') IS NOT NULL THEN
    REVOKE ALL ON SCHEMA loopscope FROM loopscope_engineer; REVOKE ALL ON ALL TABLES IN SCHEMA loopscope FROM loopscope_engineer;
    REVOKE ALL ON ALL SEQUENCES IN SCHEMA loopscope FROM loopscope_engineer; REVOKE ALL ON ALL FUNCTIONS IN SCHEMA loopscope FROM loopscope_engineer;
    GRANT USAGE ON SCHEMA loopscope TO loopscope_engineer; GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO loopscope_engineer;
    -- Without author and entered_at: who said it, and when, is the server's to note.
    GRANT INSERT (loop_id, kind, code, until, reason), UPDATE (withdrawn_at) ON loopscope.annotation TO loopscope_engineer;
    GRANT INSERT (loop_id, done_at, kind, description) ON loopscope.maintenance_event TO loopscope_engineer;
  END IF;
  IF to_regrole('loopscope_worker') IS NOT NULL THEN
    GRANT INSERT, UPDATE (loops, oscillating, events, found_at) ON loopscope.plant_round TO loopscope_worker;
    GRANT INSERT, UPDATE (status, confirmed_at, ended_at, ended_by) ON loopscope.flag_notice TO loopscope_worker;
  END IF;
  FOREACH grantee IN ARRAY '{loopscope_worker,loopscope_reader,loopscope_engineer}'::text[] LOOP
    CONTINUE WHEN to_regrole(grantee) IS NULL;
    EXECUTE 'GRANT EXECUTE ON FUNCTION loopscope.verdict_run, loopscope.flagged_at, loopscope.oldest_program TO ' || grantee;
  END LOOP;
END $$;
COMMENT ON FUNCTION loopscope.grant_rights_of_0012() IS 'The part of grant_rights() that stood before there were engineers';
COMMENT ON FUNCTION loopscope.grant_rights() IS 'Gives loopscope_worker, loopscope_reader and loopscope_engineer, where they exist, exactly the rights that they need, and takes every other one back';

ALTER FUNCTION loopscope.delete_old_rows(timestamptz) RENAME TO delete_old_rows_of_0012;
CREATE FUNCTION loopscope.delete_old_rows(before timestamptz) RETURNS void LANGUAGE sql SET search_path = pg_catalog AS $$
  SELECT loopscope.delete_old_rows_of_0012(before);
  DELETE FROM loopscope.plant_round WHERE slot_end < before;
  DELETE FROM loopscope.flag_notice WHERE ended_at < before;
$$;
COMMENT ON FUNCTION loopscope.delete_old_rows(timestamptz) IS 'Deletes results older than `before` that lie in no monthly partition';
COMMENT ON FUNCTION loopscope.delete_old_rows_of_0012(timestamptz) IS 'The part of delete_old_rows() that stood before there were notices';

-- As in 0006, for the new tables too: a column that is named like an older one means the same.
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT DISTINCT ON (class.oid, shown.attnum) class.relname, shown.attname, col_description(source.attrelid, source.attnum) AS words
    FROM pg_class AS class
    JOIN pg_attribute AS shown ON shown.attrelid = class.oid AND shown.attnum > 0
    JOIN unnest('{hiding,flag_notice,plant_round,plant_oscillation,newest_plant_round,annotation,analysis,verdict,loop,latest_verdict}'::text[])
      WITH ORDINALITY AS origin (name, priority) ON true
    JOIN pg_attribute AS source ON source.attrelid = format('loopscope.%I', origin.name)::regclass AND source.attname = shown.attname
     AND col_description(source.attrelid, source.attnum) IS NOT NULL
    WHERE class.relnamespace = 'loopscope'::regnamespace AND class.relkind IN ('r', 'v') AND col_description(class.oid, shown.attnum) IS NULL
    ORDER BY class.oid, shown.attnum, origin.priority
  LOOP
    EXECUTE format('COMMENT ON COLUMN loopscope.%I.%I IS %L', missing.relname, missing.attname, missing.words);
  END LOOP;
END $$;
