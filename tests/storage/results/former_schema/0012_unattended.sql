-- Workers that die: which loops were in their hands each time. And which programs may use this schema.

-- attempts counts every failure; a loop that takes its worker down with it needs more than a pause:
-- it must not be claimed together with others. Failures that a worker survived do not count here.
ALTER TABLE loopscope.schedule ADD COLUMN lost_leases integer NOT NULL DEFAULT 0;
COMMENT ON COLUMN loopscope.schedule.lost_leases IS 'Leases in a row that ended without a word of the worker; from the third on the loop is claimed alone, from the fourth on after growing pauses';

-- Expand, then contract: a program works on a newer schema as long as that was only added to. A
-- migration that takes something away which programs of schema version N still use replaces this
-- function by one that returns N + 1.
CREATE FUNCTION loopscope.oldest_program() RETURNS integer IMMUTABLE LANGUAGE sql RETURN 12;
COMMENT ON FUNCTION loopscope.oldest_program() IS 'The lowest schema version whose programs still work on this schema';

-- One row per process: who is at work, since when, and whether it still says so.
CREATE TABLE loopscope.worker (
  worker             text PRIMARY KEY CHECK (worker <> ''),
  program_version    text NOT NULL,
  algorithm_revision integer NOT NULL,
  started_at         timestamptz NOT NULL DEFAULT now(),
  last_seen          timestamptz NOT NULL DEFAULT now(),
  held_loops         integer NOT NULL,
  lost_leases        bigint NOT NULL
) WITH (fillfactor = 50);
COMMENT ON TABLE loopscope.worker IS 'Processes that analyse, one row each; rows that nobody renews are removed by maintain';
COMMENT ON COLUMN loopscope.worker.worker IS 'host/pid, the beginning of schedule.owner';
COMMENT ON COLUMN loopscope.worker.program_version IS 'Version of the program';
COMMENT ON COLUMN loopscope.worker.algorithm_revision IS 'Revision of the analysis that it writes';
COMMENT ON COLUMN loopscope.worker.started_at IS 'When it spoke first';
COMMENT ON COLUMN loopscope.worker.last_seen IS 'When it spoke last: every third of a lease while it runs';
COMMENT ON COLUMN loopscope.worker.held_loops IS 'Loops in its hands at that time';
COMMENT ON COLUMN loopscope.worker.lost_leases IS 'Leases that it lost to others since its start';

-- Exactly these rights (storage/README.md, "Roles", is the list, and a test
-- compares): what somebody has granted to the group roles besides, and what former versions granted, is taken back.
-- Nobody sees the moment between, because it is one transaction. The worker's UPDATE leaves out every key, so
-- that no row of results can be passed off as another's, and holds no lock that stops readers.

CREATE OR REPLACE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
DECLARE
  grantee text;
  written record;
BEGIN
  FOREACH grantee IN ARRAY ARRAY['PUBLIC', 'loopscope_worker', 'loopscope_reader', 'loopscope_historian'] LOOP
    CONTINUE WHEN grantee <> 'PUBLIC' AND to_regrole(grantee) IS NULL;
    EXECUTE 'REVOKE ALL ON SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL TABLES IN SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL SEQUENCES IN SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL FUNCTIONS IN SCHEMA loopscope FROM ' || grantee;
  END LOOP;
  IF to_regrole('loopscope_worker') IS NOT NULL THEN
    GRANT USAGE ON SCHEMA loopscope TO loopscope_worker;
    GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO loopscope_worker;
    GRANT UPDATE (visible_at, owner, fence, attempts, lost_leases, last_error, last_slot_end, result_slot_end)
      ON loopscope.schedule TO loopscope_worker;
    GRANT UPDATE (value) ON loopscope.parameter TO loopscope_worker;
    GRANT INSERT ON loopscope.analysis, loopscope.bicoherence_peak, loopscope.explanation_step, loopscope.verdict,
      loopscope.plant_oscillation, loopscope.standing_problem, loopscope.stage_cost, loopscope.worker TO loopscope_worker;
    FOR written IN
      SELECT class.relname, string_agg(quote_ident(part.attname), ', ' ORDER BY part.attnum) AS columns
      FROM pg_class AS class
      JOIN pg_attribute AS part ON part.attrelid = class.oid AND part.attnum > 0 AND NOT part.attisdropped
      WHERE class.relnamespace = 'loopscope'::regnamespace
        AND class.relname IN ('analysis', 'plant_oscillation', 'standing_problem', 'stage_cost', 'worker')
        AND part.attname <> 'analysis_id'
        AND NOT EXISTS (SELECT FROM pg_index AS key WHERE key.indrelid = class.oid AND key.indisprimary
                                                      AND part.attnum = ANY (key.indkey))
      GROUP BY class.relname
    LOOP
      EXECUTE format('GRANT UPDATE (%s) ON loopscope.%I TO loopscope_worker', written.columns, written.relname);
    END LOOP;
    GRANT USAGE ON SEQUENCE loopscope.analysis_id TO loopscope_worker;
    GRANT EXECUTE ON FUNCTION loopscope.oldest_program() TO loopscope_worker;
  END IF;
  IF to_regrole('loopscope_reader') IS NOT NULL THEN
    GRANT USAGE ON SCHEMA loopscope TO loopscope_reader;
    GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO loopscope_reader;
  END IF;
END $$;
COMMENT ON FUNCTION loopscope.grant_rights() IS 'Gives loopscope_worker and loopscope_reader, where they exist, exactly the rights that they need, and takes every other one back';

-- A month without a word: the process is gone, and its rows with it.
CREATE OR REPLACE FUNCTION loopscope.delete_old_rows(before timestamptz) RETURNS void LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
DECLARE parent text;
BEGIN
  FOREACH parent IN ARRAY loopscope.partitioned_tables() LOOP
    EXECUTE format('DELETE FROM loopscope.%I WHERE slot_end < %L', parent || '_default', before);
  END LOOP;
  DELETE FROM loopscope.plant_oscillation WHERE slot_end < before;
  DELETE FROM loopscope.stage_cost WHERE hour < before;
  DELETE FROM loopscope.worker WHERE last_seen < now() - interval '1 month';
END $$;
