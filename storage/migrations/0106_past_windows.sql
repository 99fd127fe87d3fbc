-- What a window tells the next one is kept with it: slots of the past can then be judged in their order at any time,
-- each with what was known by then, while schedule says what the newest slot has told.
ALTER TABLE loopscope.analysis
  ADD COLUMN pv_flat_s double precision,
  ADD COLUMN pv_step double precision;

DO $$
DECLARE described regclass;
BEGIN
  FOR described IN SELECT relid FROM pg_partition_tree('loopscope.analysis') LOOP
    EXECUTE format('COMMENT ON COLUMN %s.pv_flat_s IS %L', described,
      'What schedule.pv_flat_s was from this window on, until the next; null = by a program before schema 106');
    EXECUTE format('COMMENT ON COLUMN %s.pv_step IS %L', described,
      'What schedule.pv_step was from this window on, until the next; null = not known');
  END LOOP;
END $$;

-- Whoever judges windows of the past leaves due loops to those who judge the newest ones: as long as there are any.
ALTER TABLE loopscope.worker ADD COLUMN left_at timestamptz;
COMMENT ON COLUMN loopscope.worker.left_at IS
  'When it said that it ends; null = at work, lost, or a program before schema 106';
