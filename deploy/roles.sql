-- The group roles of Loopscope. Run once per database as a superuser, before `loopscope migrate`:
--   psql -d DATABASE -f roles.sql
-- Running it again changes nothing. Nobody can log in as these: create a login per program or
-- person and make it a member, e.g.  CREATE ROLE plant_monitor LOGIN IN ROLE loopscope_worker;
--
--   loopscope_owner      owns the schema loopscope: migrate, maintain, loops
--   loopscope_worker     the daemon: reads the catalogue, claims loops, writes results
--   loopscope_reader     people and dashboards: reads results
--   loopscope_engineer   people who work with findings: reads results, annotates, enters repairs
--   loopscope_historian  reads the historian; its tables belong to the site, so the site grants them:
--                        GRANT USAGE ON SCHEMA public TO loopscope_historian;
--                        GRANT SELECT ON public.history TO loopscope_historian;
--
-- Where the database holds no tables but Loopscope's, PUBLIC loses what PostgreSQL gives to everybody who may
-- connect: temporary tables, large objects, messages in the write-ahead log, and (clusters that are older than PostgreSQL 15) tables in the schema
-- public; and queries are no longer compiled (jit), which takes longer than the views themselves: tens of seconds.
-- A database that is shared is left as it is: its other users may need that.

-- Whoever may create functions in a schema of the search path could put one of his own into the place of PostgreSQL's
-- (format(text, name), say), and it would run with a superuser's rights.
SET search_path = pg_catalog, pg_temp;

DO $$
DECLARE role record;
BEGIN
  FOR role IN SELECT * FROM (VALUES
    ('loopscope_owner', 'Loopscope: owns the results schema'),
    ('loopscope_worker', 'Loopscope: the daemon'),
    ('loopscope_reader', 'Loopscope: people and dashboards, read only'),
    ('loopscope_engineer', 'Loopscope: people who annotate findings and enter repairs'),
    ('loopscope_historian', 'Loopscope: reads the historian')) AS needed (name, purpose)
  LOOP
    IF to_regrole(role.name) IS NULL THEN
      BEGIN
        EXECUTE format('CREATE ROLE %I NOLOGIN', role.name);
        EXECUTE format('COMMENT ON ROLE %I IS %L', role.name, role.purpose);
      EXCEPTION WHEN duplicate_object OR unique_violation THEN
        NULL;  -- another session made it in this moment
      END;
    END IF;
  END LOOP;
  -- For the schema itself; it may be taken back after the first migrate.
  EXECUTE format('GRANT CREATE ON DATABASE %I TO loopscope_owner', current_database());
END $$;

DO $$
DECLARE emitter pg_catalog.regprocedure;
BEGIN
  IF EXISTS (
    SELECT FROM pg_catalog.pg_class AS class
    JOIN pg_catalog.pg_namespace AS namespace ON namespace.oid = class.relnamespace
    WHERE class.relkind IN ('r', 'p', 'v', 'm', 'f')
      AND namespace.nspname NOT IN ('pg_catalog', 'information_schema', 'loopscope')
      AND namespace.nspname !~ '^pg_(toast|temp)') THEN
    RAISE NOTICE 'the database is shared: PUBLIC keeps temporary tables and large objects, queries may be compiled (jit)';
  ELSE
    EXECUTE format('REVOKE TEMPORARY ON DATABASE %I FROM PUBLIC', current_database());
    REVOKE CREATE ON SCHEMA public FROM PUBLIC;
    REVOKE EXECUTE ON FUNCTION pg_catalog.lo_create(oid), pg_catalog.lo_creat(integer),
      pg_catalog.lo_from_bytea(oid, bytea) FROM PUBLIC;
    EXECUTE format('ALTER DATABASE %I SET jit = off', current_database());
    -- Any number of megabytes of the write-ahead log a call; its arguments differ from version to version.
    FOR emitter IN SELECT oid::regprocedure FROM pg_catalog.pg_proc
                   WHERE proname = 'pg_logical_emit_message' AND pronamespace = 'pg_catalog'::regnamespace LOOP
      EXECUTE format('REVOKE EXECUTE ON FUNCTION %s FROM PUBLIC', emitter);
    END LOOP;
  END IF;
END $$;
