-- Who may do what, what no right allows, and what goes with time.

-- Exactly these rights (storage/README.md, "Roles", is the list, and a test compares): `migrate` calls this every
-- time, so that a role that is created later gets its rights with the next call, and whatever else the groups were
-- given is taken back. Nobody sees the moment between, because it is one transaction. The worker's UPDATE leaves out
-- every key, so that no row of results can be passed off as another's, and holds no lock that stops readers.
CREATE OR REPLACE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
DECLARE
  grantee text;
  written record;
BEGIN
  FOREACH grantee IN ARRAY '{PUBLIC,loopscope_historian,loopscope_worker,loopscope_reader,loopscope_engineer}'::text[]
  LOOP
    CONTINUE WHEN grantee <> 'PUBLIC' AND to_regrole(grantee) IS NULL;
    EXECUTE 'REVOKE ALL ON SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL TABLES IN SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL SEQUENCES IN SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL FUNCTIONS IN SCHEMA loopscope FROM ' || grantee;
    CONTINUE WHEN grantee IN ('PUBLIC', 'loopscope_historian');
    EXECUTE 'GRANT USAGE ON SCHEMA loopscope TO ' || grantee;
    EXECUTE 'GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO ' || grantee;
    -- What views call is called with the rights of whoever asks.
    EXECUTE 'GRANT EXECUTE ON FUNCTION loopscope.verdict_run, loopscope.flagged_at, loopscope.list_questions, '
            'loopscope.last_fault, loopscope.oldest_program TO ' || grantee;
  END LOOP;
  IF to_regrole('loopscope_reader') IS NOT NULL THEN
    GRANT SELECT ON ALL SEQUENCES IN SCHEMA loopscope TO loopscope_reader;  -- for pg_dump
  END IF;
  IF to_regrole('loopscope_engineer') IS NOT NULL THEN
    -- Without author and entered_at: who said it, and when, is the server's to note.
    GRANT INSERT (loop_id, kind, code, until, reason), UPDATE (withdrawn_at)
      ON loopscope.annotation TO loopscope_engineer;
    GRANT INSERT (loop_id, done_at, kind, description) ON loopscope.maintenance_event TO loopscope_engineer;
  END IF;
  IF to_regrole('loopscope_worker') IS NOT NULL THEN
    GRANT UPDATE (visible_at, owner, fence, attempts, lost_leases, last_error, last_slot_end, result_slot_end, hold_s,
                  pv_flat_s, pv_step) ON loopscope.schedule TO loopscope_worker;
    GRANT UPDATE (value) ON loopscope.parameter TO loopscope_worker;
    GRANT UPDATE (owner, until, hold_s) ON loopscope.task_lease TO loopscope_worker;
    GRANT UPDATE (status, confirmed_at, ended_at, ended_by) ON loopscope.flag_notice TO loopscope_worker;
    GRANT INSERT ON loopscope.analysis, loopscope.bicoherence_peak, loopscope.explanation_step, loopscope.verdict,
      loopscope.plant_oscillation, loopscope.plant_round, loopscope.standing_problem, loopscope.stage_cost,
      loopscope.worker, loopscope.flag_notice, loopscope.repair_judgement TO loopscope_worker;
    FOR written IN
      SELECT class.relname, string_agg(quote_ident(part.attname), ', ' ORDER BY part.attnum) AS columns
      FROM pg_class AS class
      JOIN pg_attribute AS part ON part.attrelid = class.oid AND part.attnum > 0 AND NOT part.attisdropped
      WHERE class.relnamespace = 'loopscope'::regnamespace
        AND class.relname IN ('analysis', 'plant_oscillation', 'plant_round', 'standing_problem', 'stage_cost',
                              'worker', 'repair_judgement')
        AND part.attname <> 'analysis_id'
        AND NOT EXISTS (SELECT FROM pg_index AS key WHERE key.indrelid = class.oid AND key.indisprimary
                                                      AND part.attnum = ANY (key.indkey))
      GROUP BY class.relname
    LOOP
      EXECUTE format('GRANT UPDATE (%s) ON loopscope.%I TO loopscope_worker', written.columns, written.relname);
    END LOOP;
    GRANT USAGE ON SEQUENCE loopscope.analysis_id TO loopscope_worker;
  END IF;
END $$;
COMMENT ON FUNCTION loopscope.grant_rights() IS
  'Gives loopscope_worker, loopscope_reader and loopscope_engineer, where they exist, exactly the rights that they '
  'need, and takes every other one back';

-- From one claim to the next the fence rises by one: it can be neither turned back nor brought to its end.
CREATE OR REPLACE FUNCTION loopscope.refuse_fence() RETURNS trigger LANGUAGE plpgsql SET search_path = pg_catalog AS $$
BEGIN
  RAISE EXCEPTION 'schedule.fence of loop % rises by one with each claim, not from % to %', OLD.loop_id,
    OLD.fence, NEW.fence USING ERRCODE = 'check_violation';
END $$;
COMMENT ON FUNCTION loopscope.refuse_fence() IS 'Refuses a fence that does not rise by one';
CREATE OR REPLACE TRIGGER fence_rises BEFORE UPDATE OF fence ON loopscope.schedule FOR EACH ROW
  WHEN (NEW.fence < OLD.fence OR NEW.fence > OLD.fence + 1) EXECUTE FUNCTION loopscope.refuse_fence();

CREATE OR REPLACE FUNCTION loopscope.refuse_second_schedule() RETURNS trigger LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
DECLARE doubled bigint;
BEGIN
  SELECT min(added.loop_id) INTO doubled FROM added JOIN loopscope.schedule AS kept USING (loop_id)
  WHERE kept.fence <> added.fence;
  IF doubled IS NOT NULL THEN
    RAISE EXCEPTION 'loop % has its row in loopscope.schedule already', doubled USING ERRCODE = 'unique_violation';
  END IF;
  RETURN NULL;
END $$;
COMMENT ON FUNCTION loopscope.refuse_second_schedule() IS 'Refuses a second row of one loop in loopscope.schedule';
CREATE OR REPLACE TRIGGER one_row AFTER INSERT ON loopscope.schedule
  REFERENCING NEW TABLE AS added FOR EACH STATEMENT EXECUTE FUNCTION loopscope.refuse_second_schedule();

-- A worker without a word for a month is gone, and its row with it.
CREATE OR REPLACE FUNCTION loopscope.delete_old_rows(before timestamptz) RETURNS void LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
DECLARE parent text;
BEGIN
  FOREACH parent IN ARRAY loopscope.partitioned_tables() LOOP
    EXECUTE format('DELETE FROM loopscope.%I WHERE slot_end < %L', parent || '_default', before);
  END LOOP;
  DELETE FROM loopscope.plant_oscillation WHERE slot_end < before;
  DELETE FROM loopscope.plant_round WHERE slot_end < before;
  DELETE FROM loopscope.flag_notice WHERE ended_at < before;
  DELETE FROM loopscope.stage_cost WHERE hour < before;
  DELETE FROM loopscope.worker WHERE last_seen < now() - interval '1 month';
END $$;
COMMENT ON FUNCTION loopscope.delete_old_rows(timestamp with time zone) IS
  'Deletes results older than `before` that lie in no monthly partition';
