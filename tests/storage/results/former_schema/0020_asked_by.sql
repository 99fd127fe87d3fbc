-- What led the loop model to each of its effects: the residual tests that asked for it.

-- Programs of before, which may still be at work, do not say: they leave it null, and never claim that no test asked.
ALTER TABLE loopscope.explanation_step ADD COLUMN asked_by jsonb;
COMMENT ON COLUMN loopscope.explanation_step.asked_by IS 'Residual tests that asked for the effect, most significant first: [{test, p, p_after, statement}], p of the residual before the effect and after it (null = not asked again); [] = none asked, a first look showed it; null = of a program before schema 20';
COMMENT ON COLUMN loopscope.analysis.model IS 'The loop model but its steps: excitation, baseline (description, process), asked (effects that residual tests asked for at first), unexplained, questions, closed_loop; null = no model. Steps: explanation_step';

-- A partition's columns have comments of their own.
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT part.inhrelid::regclass AS name, own.attname, col_description(part.inhparent, whole.attnum) AS words
    FROM pg_inherits AS part
    JOIN pg_attribute AS own ON own.attrelid = part.inhrelid AND own.attnum > 0 AND NOT own.attisdropped
    JOIN pg_attribute AS whole ON whole.attrelid = part.inhparent AND whole.attname = own.attname
    WHERE part.inhparent IN ('loopscope.analysis'::regclass, 'loopscope.explanation_step'::regclass)
      AND col_description(part.inhrelid, own.attnum) IS DISTINCT FROM col_description(part.inhparent, whole.attnum)
  LOOP
    EXECUTE format('COMMENT ON COLUMN %s.%I IS %L', missing.name, missing.attname, missing.words);
  END LOOP;
END $$;

CREATE OR REPLACE VIEW loopscope.explanation AS
  SELECT latest.loop_id, latest.loop_name, latest.slot_end, latest.algorithm_revision, latest.input_revision,
         latest.code, taken.step, taken.effect, taken.parameters, taken.intervals,
         taken.holdout_error_before, taken.holdout_error_after,
         taken.holdout_error_after / nullif(taken.holdout_error_before, 0) AS error_ratio,
         taken.evidence, taken.p, taken.margin, taken.simulation_ratio, taken.steadiness, taken.statement,
         taken.asked_by
  FROM loopscope.latest_verdict AS latest
  JOIN loopscope.explanation_step AS taken USING (loop_id, slot_end, algorithm_revision, input_revision);
COMMENT ON COLUMN loopscope.explanation.asked_by IS 'Residual tests that asked for the effect, most significant first: [{test, p, p_after, statement}]; [] = none asked, a first look showed it; null = of a program before schema 20';
