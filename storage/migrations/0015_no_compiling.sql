-- Compiling a query on the views takes up to tens of seconds, running it a fraction of one. A database of our own is told not
-- to; of others, deploy/roles.sql does, or their owner (storage/README.md).
DO $$
BEGIN
  IF EXISTS (SELECT FROM pg_database WHERE datname = current_database() AND datdba = current_user::regrole) THEN
    EXECUTE format('ALTER DATABASE %I SET jit = off', current_database());
  END IF;
END $$;
