-- The group roles of Loopscope. Run once per database as a superuser, before `loopscope migrate`:
--   psql -d DATABASE -f roles.sql
-- Running it again changes nothing. Nobody can log in as these: create a login per program or
-- person and make it a member, e.g.  CREATE ROLE plant_monitor LOGIN IN ROLE loopscope_worker;
--
--   loopscope_owner      owns the schema loopscope: migrate, maintain, loops
--   loopscope_worker     the daemon: reads the catalogue, claims loops, writes results
--   loopscope_reader     people and dashboards: reads results
--   loopscope_historian  reads the historian; its tables belong to the site, so the site grants them:
--                        GRANT USAGE ON SCHEMA public TO loopscope_historian;
--                        GRANT SELECT ON public.history TO loopscope_historian;

DO $$
DECLARE role record;
BEGIN
  FOR role IN SELECT * FROM (VALUES
    ('loopscope_owner', 'Loopscope: owns the results schema'),
    ('loopscope_worker', 'Loopscope: the daemon'),
    ('loopscope_reader', 'Loopscope: people and dashboards, read only'),
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
  EXECUTE format('GRANT CREATE ON DATABASE %I TO loopscope_owner', current_database());
END $$;
