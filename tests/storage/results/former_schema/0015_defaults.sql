-- What a fresh database begins with.

-- Compiling a query on the views takes up to tens of seconds, running it a fraction of one. A database of our own is told not
-- to; of others, deploy/roles.sql does, or their owner (storage/README.md).
DO $$
BEGIN
  IF EXISTS (SELECT FROM pg_database WHERE datname = current_database() AND datdba = current_user::regrole) THEN
    EXECUTE format('ALTER DATABASE %I SET jit = off', current_database());
  END IF;
END $$;

-- The default of the settings file, which every worker writes here: at 0.05 one simulated plant of 500 loops in four has
-- more than two false flags beside its 25 faults, and at 0.005 no fault is lost (tests/plants/README.md).
UPDATE loopscope.parameter SET value = 0.005 WHERE name = 'false_discovery_rate' AND value = 0.05;
