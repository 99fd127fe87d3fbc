-- What the tests rest on, what else was found about the noise, and records too short for them.

-- What is stored satisfies the narrower check of before: no table is read, under whatever lock.
ALTER TABLE loopscope.analysis
  DROP CONSTRAINT analysis_coupling_check,
  ADD CONSTRAINT analysis_coupling_check
    CHECK (coupling IN ('none_found', 'quadratic', 'cubic', 'both', 'too_short')) NOT VALID,
  ADD COLUMN innovation_p double precision,
  ADD COLUMN tested_on text,
  ADD COLUMN heavy_tails_p double precision,
  ADD COLUMN variance_changes_p double precision,
  ADD CONSTRAINT analysis_tested_on_check CHECK (tested_on IN ('error', 'model_residual')) NOT VALID;
COMMENT ON COLUMN loopscope.analysis.coupling IS 'What the error signal couples: none_found, quadratic, cubic, both, or too_short: too few cycles for any to be found';
COMMENT ON COLUMN loopscope.analysis.innovation_p IS 'p of the innovations depending on squares or cubes of the past; null = not asked, since the noise is normal or nothing was near significance';
COMMENT ON COLUMN loopscope.analysis.tested_on IS 'What the p-values rest on: error (sp - pv), or model_residual, the error less the linear answer to a setpoint that moves all the time';
COMMENT ON COLUMN loopscope.analysis.heavy_tails_p IS 'p against normal noise of the outliers in what drives the loop';
COMMENT ON COLUMN loopscope.analysis.variance_changes_p IS 'p against noise of one strength of the bursts in what drives the loop';

-- A partition's columns have comments of their own.
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT part.inhrelid::regclass AS name, own.attname, col_description(part.inhparent, whole.attnum) AS words
    FROM pg_inherits AS part
    JOIN pg_attribute AS own ON own.attrelid = part.inhrelid AND own.attnum > 0 AND NOT own.attisdropped
    JOIN pg_attribute AS whole ON whole.attrelid = part.inhparent AND whole.attname = own.attname
    WHERE part.inhparent = 'loopscope.analysis'::regclass
      AND col_description(part.inhrelid, own.attnum) IS DISTINCT FROM col_description(part.inhparent, whole.attnum)
  LOOP
    EXECUTE format('COMMENT ON COLUMN %s.%I IS %L', missing.name, missing.attname, missing.words);
  END LOOP;
END $$;
