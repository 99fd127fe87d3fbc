-- What keeps a loop from being judged, or makes a verdict worth less, with the tag to mend.

-- A flag of the analysis needs a row here to be put into words; one without is shown as it is.
CREATE TABLE loopscope.data_problem_kind (
  code   text PRIMARY KEY CHECK (code <> ''),
  role   text CHECK (role IN ('sp', 'pv', 'op', 'mv', 'mode')),
  shown  boolean NOT NULL,
  words  text NOT NULL,
  remedy text NOT NULL
);
COMMENT ON TABLE loopscope.data_problem_kind IS 'Every flag and every other problem of data in words; a new flag needs one row here, without it is shown as it is';
COMMENT ON COLUMN loopscope.data_problem_kind.code IS 'Flag of analysis.flags, or code of a problem that the monitor sees on the tag itself';
COMMENT ON COLUMN loopscope.data_problem_kind.role IS 'What of the loop it is about; null = the problem itself says so';
COMMENT ON COLUMN loopscope.data_problem_kind.shown IS 'Whether data_problem shows it: false for what is information and nobody''s to mend';
COMMENT ON COLUMN loopscope.data_problem_kind.words IS 'What it means, in words';
COMMENT ON COLUMN loopscope.data_problem_kind.remedy IS 'What mends it';

INSERT INTO loopscope.data_problem_kind (code, role, shown, words, remedy) VALUES
  ('insufficient_data', 'pv', true, 'The loop cannot be judged', 'Mend the tag; see the other problems of the loop'),
  ('no_rows', NULL, true, 'The historian has no row of this tag', 'Correct the tag in the catalogue (loopscope loops check), or have the historian record it'),
  ('dead_tag', NULL, true, 'The tag has stopped: its newest row is old', 'Check collector, interface and transmitter'),
  ('bad_quality', NULL, true, 'Most rows of the window are of bad quality', 'Check transmitter, wiring and interface'),
  ('future_rows', NULL, true, 'Rows are stamped in the future; they are not read', 'Mend the clock or the time zone of the sender'),
  ('pv_constant', 'pv', true, 'pv does not vary', 'Check transmitter and archive; a dead band may be wider than the noise'),
  ('pv_frozen', 'pv', true, 'pv stands still for hundreds of samples while op moves', 'Check transmitter, its damping and the archive'),
  ('pv_held', 'pv', true, 'pv is renewed too seldom: compression or a slow scan', 'Lower exception and compression deviation of the tag, or scan it faster'),
  ('pv_quantised', 'pv', true, 'The steps of pv are coarse beside its own spread', 'Narrow the range of the transmitter, or record more digits'),
  ('pv_spikes', 'pv', true, 'Isolated outliers of pv were taken out', 'Check wiring, shielding and interface'),
  ('sp_missing', 'sp', true, 'No set point: the mean of pv stands in', 'Name the sp tag in the catalogue and have it recorded'),
  ('sp_moving', 'sp', false, 'The set point moves all the time (cascade or ratio)', ''),
  ('sp_steps_masked', 'sp', false, 'Steps of the set point were kept out of the statistics', ''),
  ('sp_not_followed', 'sp', true, 'pv stays far from the set point: the controller is not in command, or the tag is another loop''s', 'Check that sp and pv belong together; disable the loop if something else holds the valve'),
  ('op_missing', 'op', true, 'No controller output: model and valve cannot be judged', 'Name the op tag in the catalogue and have it recorded'),
  ('op_constant', 'op', true, 'The controller output does not move', 'Check mode and tag; a dead band of the archive may be too wide'),
  ('op_range_unknown', 'op', true, 'The controller output does not fit into 0 to 100 and its range is not given', 'Set op_low and op_high in the catalogue'),
  ('manual_mode', 'mode', true, 'The controller was in manual for part of the window', 'Put it into automatic, or disable the loop'),
  ('repeated_times', 'pv', true, 'Rows have the same time; the last one counts', 'Check the writer for repeated sending'),
  ('short', 'pv', true, 'Fewer than 32 segments: findings count less', 'Record without gaps, or wait until the window is full');

CREATE TABLE loopscope.standing_problem (
  loop_id       bigint NOT NULL REFERENCES loopscope.loop ON DELETE CASCADE,
  code          text NOT NULL,
  role          text NOT NULL CHECK (role IN ('', 'sp', 'pv', 'op', 'mv', 'mode')),
  first_slot    timestamptz NOT NULL,
  last_slot     timestamptz NOT NULL,
  previous_slot timestamptz,
  slots         integer NOT NULL CHECK (slots > 0),
  last_row      timestamptz,
  figure        double precision,
  PRIMARY KEY (loop_id, code, role)
) WITH (fillfactor = 80, autovacuum_vacuum_scale_factor = 0.02);
COMMENT ON TABLE loopscope.standing_problem IS 'Since when each problem of a loop''s data stands: read it through data_problem';
COMMENT ON COLUMN loopscope.standing_problem.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.standing_problem.code IS 'See data_problem_kind';
COMMENT ON COLUMN loopscope.standing_problem.role IS 'Tag that it is about; empty = as data_problem_kind says';
COMMENT ON COLUMN loopscope.standing_problem.first_slot IS 'First slot of the unbroken row of slots';
COMMENT ON COLUMN loopscope.standing_problem.last_slot IS 'Newest slot that had it; it stands while that is the loop''s newest slot';
COMMENT ON COLUMN loopscope.standing_problem.previous_slot IS 'Slot of the loop before last_slot';
COMMENT ON COLUMN loopscope.standing_problem.slots IS 'Analysed slots in a row that had it';
COMMENT ON COLUMN loopscope.standing_problem.last_row IS 'Time of the tag''s newest row; null = none, or not about rows';
COMMENT ON COLUMN loopscope.standing_problem.figure IS 'How much of it: share of bad rows, number of rows in the future';

CREATE VIEW loopscope.data_problem AS
  SELECT latest.loop_id, latest.loop_name, latest.source, problem.role,
         CASE problem.role WHEN 'sp' THEN loop.sp_tag WHEN 'pv' THEN loop.pv_tag WHEN 'op' THEN loop.op_tag
                           WHEN 'mv' THEN loop.mv_tag WHEN 'mode' THEN loop.mode_tag END AS tag,
         problem.code AS problem, problem.words, problem.remedy, latest.usable AS judged,
         problem.since, problem.slots, problem.last_row, problem.figure, latest.slot_end
  FROM loopscope.latest_verdict AS latest
  JOIN loopscope.loop USING (loop_id)
  JOIN loopscope.schedule USING (loop_id)
  CROSS JOIN LATERAL (
    -- What the analysis itself says ...
    SELECT said.code,
           CASE WHEN said.code = 'insufficient_data' AND measured.unusable_reason LIKE '%manual%' THEN 'mode'
                ELSE kind.role END AS role,
           CASE WHEN said.code = 'insufficient_data' THEN kind.words || ': ' || measured.unusable_reason
                ELSE coalesce(kind.words, replace(said.code, '_', ' ')) END AS words,
           coalesce(kind.remedy, '') AS remedy,
           coalesce(standing.first_slot, latest.slot_end) AS since, coalesce(standing.slots, 1) AS slots,
           standing.last_row, standing.figure
    FROM (SELECT usable, unusable_reason, flags FROM loopscope.analysis
          WHERE analysis.loop_id = latest.loop_id AND analysis.slot_end = latest.slot_end
            AND analysis.algorithm_revision = latest.algorithm_revision LIMIT 1) AS measured
    CROSS JOIN LATERAL (
      SELECT flag AS code FROM unnest(measured.flags) AS flag
      UNION ALL SELECT 'insufficient_data' WHERE NOT measured.usable) AS said
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
COMMENT ON VIEW loopscope.data_problem IS 'One row per problem of an enabled loop''s newest data: the tag to mend, what is wrong, since when';
COMMENT ON COLUMN loopscope.data_problem.loop_name IS 'Name of the loop';
COMMENT ON COLUMN loopscope.data_problem.role IS 'sp, pv, op, mv or mode; null = not said';
COMMENT ON COLUMN loopscope.data_problem.tag IS 'The tag to mend; null = the catalogue names none';
COMMENT ON COLUMN loopscope.data_problem.problem IS 'Flag of the analysis, or code of data_problem_kind';
COMMENT ON COLUMN loopscope.data_problem.words IS 'What is wrong, in words';
COMMENT ON COLUMN loopscope.data_problem.remedy IS 'What mends it; empty = not known';
COMMENT ON COLUMN loopscope.data_problem.judged IS 'Whether the loop could be judged all the same';
COMMENT ON COLUMN loopscope.data_problem.since IS 'Time of the tag''s newest row where that is what is wrong, else the first slot of the unbroken row';
COMMENT ON COLUMN loopscope.data_problem.slots IS 'Analysed slots in a row that had it';

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
           NOT latest.usable AS dead_data,
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
COMMENT ON COLUMN loopscope.monitor_health.state IS 'disabled, failing, overdue (by more than a period), never_analysed, dead_data (cannot be judged), dead_tag (judged, but a tag has stopped) or ok: the first that applies';
COMMENT ON COLUMN loopscope.monitor_health.dead_tags IS 'Tags that have stopped or have no row at all; null = none';
COMMENT ON COLUMN loopscope.monitor_health.dead_roles IS 'What each of them is: sp, pv, op, mv or mode';
COMMENT ON COLUMN loopscope.monitor_health.dead_since IS 'Time of the newest row of each; where there is none, the slot that missed it first';

CREATE OR REPLACE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
BEGIN
  REVOKE ALL ON SCHEMA loopscope FROM PUBLIC;
  REVOKE ALL ON ALL FUNCTIONS IN SCHEMA loopscope FROM PUBLIC;
  IF to_regrole('loopscope_worker') IS NOT NULL THEN
    GRANT USAGE ON SCHEMA loopscope TO loopscope_worker;
    GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO loopscope_worker;
    GRANT UPDATE (visible_at, owner, fence, attempts, last_error, last_slot_end, result_slot_end)
      ON loopscope.schedule TO loopscope_worker;
    GRANT UPDATE (value) ON loopscope.parameter TO loopscope_worker;
    GRANT INSERT, UPDATE ON loopscope.analysis, loopscope.plant_oscillation, loopscope.standing_problem
      TO loopscope_worker;
    GRANT INSERT ON loopscope.bicoherence_peak, loopscope.explanation_step, loopscope.verdict TO loopscope_worker;
    GRANT USAGE ON SEQUENCE loopscope.analysis_id TO loopscope_worker;
  END IF;
  IF to_regrole('loopscope_reader') IS NOT NULL THEN
    GRANT USAGE ON SCHEMA loopscope TO loopscope_reader;
    GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO loopscope_reader;
  END IF;
END $$;

-- As in 0006: a view's column that is named like a table's column means the same.
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT DISTINCT ON (view.oid, shown.attnum) view.relname, shown.attname,
           col_description(source.attrelid, source.attnum) AS words
    FROM pg_class AS view
    JOIN pg_attribute AS shown ON shown.attrelid = view.oid AND shown.attnum > 0
    JOIN unnest('{analysis,verdict,loop,schedule,standing_problem}'::text[])
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
