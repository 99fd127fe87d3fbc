-- Whether a repair worked is judged by the program (core/repair) and stored; the view shows what is
-- stored. Before, the view computed it for every question. Programs of before read the same columns.

CREATE TABLE loopscope.repair_judgement (
  maintenance_event_id bigint PRIMARY KEY
    REFERENCES loopscope.maintenance_event ON DELETE CASCADE,
  algorithm_revision  integer NOT NULL,
  judged_at           timestamptz NOT NULL DEFAULT now(),
  newest_slot_end     timestamptz,
  min_confidence      double precision NOT NULL,
  word                text CHECK (word IN ('fixed', 'improved', 'unchanged', 'worse')),
  statement           text NOT NULL,
  windows_before      integer NOT NULL CHECK (windows_before >= 0),
  windows_after       integer NOT NULL CHECK (windows_after >= 0),
  fault_before        text,
  fault_after         text,
  variance_ratio      double precision,
  variance_ratio_low  double precision,
  variance_ratio_high double precision,
  figures             jsonb NOT NULL CHECK (jsonb_typeof(figures) = 'object')
);
COMMENT ON TABLE loopscope.repair_judgement IS 'What came of each piece of work, as the program judged it; before_after_maintenance shows it';
COMMENT ON COLUMN loopscope.repair_judgement.maintenance_event_id IS 'The piece of work';
COMMENT ON COLUMN loopscope.repair_judgement.algorithm_revision IS 'Revision of the program that judged';
COMMENT ON COLUMN loopscope.repair_judgement.judged_at IS 'When it was judged';
COMMENT ON COLUMN loopscope.repair_judgement.newest_slot_end IS 'Newest slot of the loop at that time; with another one it is judged again';
COMMENT ON COLUMN loopscope.repair_judgement.min_confidence IS 'Confidence below which verdicts counted as none (parameter)';
COMMENT ON COLUMN loopscope.repair_judgement.word IS 'fixed, improved, unchanged or worse; null = cannot be said, statement says why';
COMMENT ON COLUMN loopscope.repair_judgement.statement IS 'The word in a sentence or two with its figures; without a word, why there is none';
COMMENT ON COLUMN loopscope.repair_judgement.windows_before IS 'Windows before the work that were compared';
COMMENT ON COLUMN loopscope.repair_judgement.windows_after IS 'Windows after the work that were compared';
COMMENT ON COLUMN loopscope.repair_judgement.fault_before IS 'Fault that stands in the windows before; null = none';
COMMENT ON COLUMN loopscope.repair_judgement.fault_after IS 'Fault that stands in the windows after; null = none';
COMMENT ON COLUMN loopscope.repair_judgement.variance_ratio IS 'Variance of the error after over before; null = one side has none';
COMMENT ON COLUMN loopscope.repair_judgement.variance_ratio_low IS 'Lower end of its 90 % interval';
COMMENT ON COLUMN loopscope.repair_judgement.variance_ratio_high IS 'Upper end of its 90 % interval';
COMMENT ON COLUMN loopscope.repair_judgement.figures IS 'Every figure by name: {n_before, n_after, before, before_low, before_high, after, ..., is_ratio, change, change_low, change_high}; maintenance_figure has them as rows';

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
         coalesce(judged.statement, 'Not judged yet: a running service judges it within a minute, '
                                    'a single pass (once) at its end.') AS statement,
         coalesce(judged.windows_before, 0) AS windows_before,
         coalesce(judged.windows_after, 0) AS windows_after,
         judged.fault_before, judged.fault_after, judged.variance_ratio,
         judged.variance_ratio_low, judged.variance_ratio_high, judged.figures
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

ALTER FUNCTION loopscope.grant_rights() RENAME TO grant_rights_of_0024;
CREATE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
DECLARE written text;
BEGIN
  PERFORM loopscope.grant_rights_of_0024();
  IF to_regrole('loopscope_worker') IS NOT NULL THEN
    GRANT INSERT ON loopscope.repair_judgement TO loopscope_worker;
    SELECT string_agg(quote_ident(attname), ', ' ORDER BY attnum) INTO written
    FROM pg_attribute WHERE attrelid = 'loopscope.repair_judgement'::regclass AND attnum > 0
      AND NOT attisdropped AND attname <> 'maintenance_event_id';
    EXECUTE format('GRANT UPDATE (%s) ON loopscope.repair_judgement TO loopscope_worker', written);
  END IF;
END $$;
COMMENT ON FUNCTION loopscope.grant_rights_of_0024() IS 'The part of grant_rights() that stood before repairs were judged by the program';
COMMENT ON FUNCTION loopscope.grant_rights() IS 'Gives loopscope_worker, loopscope_reader and loopscope_engineer, where they exist, exactly the rights that they need, and takes every other one back';
