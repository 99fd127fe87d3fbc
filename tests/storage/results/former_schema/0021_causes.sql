-- How probable every cause is, beside the one that the verdict names.

-- In the catalogue's order (core/diagnosis/catalogue), four bytes each, so that a slot stays one row. Programs of before, which
-- may still be at work, leave it null.
ALTER TABLE loopscope.verdict ADD COLUMN cause_probabilities real[];
COMMENT ON COLUMN loopscope.verdict.cause_probabilities IS 'Probability of each cause, 0 to 1, in the order of verdict_kind up to nonlinear_unexplained; causes may stand together; null = the data could not be judged, or a program before schema 21';
COMMENT ON COLUMN loopscope.verdict.confidence IS 'Probability of the code, 0 to 1; before algorithm revision 16 a ranking';

-- A partition's columns have comments of their own.
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT part.inhrelid::regclass AS name, own.attname, col_description(part.inhparent, whole.attnum) AS words
    FROM pg_inherits AS part
    JOIN pg_attribute AS own ON own.attrelid = part.inhrelid AND own.attnum > 0 AND NOT own.attisdropped
    JOIN pg_attribute AS whole ON whole.attrelid = part.inhparent AND whole.attname = own.attname
    WHERE part.inhparent = 'loopscope.verdict'::regclass
      AND col_description(part.inhrelid, own.attnum) IS DISTINCT FROM col_description(part.inhparent, whole.attnum)
  LOOP
    EXECUTE format('COMMENT ON COLUMN %s.%I IS %L', missing.name, missing.attname, missing.words);
  END LOOP;
END $$;

CREATE VIEW loopscope.verdict_cause AS
  SELECT loop.loop_id, loop.name AS loop_name, given.slot_end, given.algorithm_revision, given.input_revision,
         given.code, weighed.cause, weighed.probability
  FROM loopscope.loop
  JOIN loopscope.verdict AS given USING (loop_id)
  CROSS JOIN LATERAL unnest(
    '{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,nonlinear_unexplained}'::text[],
    given.cause_probabilities) AS weighed (cause, probability)
  WHERE weighed.probability IS NOT NULL;
COMMENT ON VIEW loopscope.verdict_cause IS 'One row per verdict and cause: how probable the cause is; ask for one loop or slot. Verdicts of programs before schema 21 have none';
COMMENT ON COLUMN loopscope.verdict_cause.loop_id IS 'The loop';
COMMENT ON COLUMN loopscope.verdict_cause.loop_name IS 'Name of the loop';
COMMENT ON COLUMN loopscope.verdict_cause.slot_end IS 'End of the slot';
COMMENT ON COLUMN loopscope.verdict_cause.algorithm_revision IS 'Revision of the diagnosis';
COMMENT ON COLUMN loopscope.verdict_cause.input_revision IS 'Revision of the input; the highest is the newest';
COMMENT ON COLUMN loopscope.verdict_cause.code IS 'The verdict that was given';
COMMENT ON COLUMN loopscope.verdict_cause.cause IS 'A cause of the catalogue (verdict_kind); nonlinear_unexplained = any nonlinearity of valve or process';
COMMENT ON COLUMN loopscope.verdict_cause.probability IS 'Probability that the cause is there, 0 to 1; causes may stand together';
