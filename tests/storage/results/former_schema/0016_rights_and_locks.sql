-- What others in the same database can neither stop nor rewrite.

-- Locks that decide something lie on rows that only a worker may lock: advisory locks are everybody's who may connect.
CREATE TABLE loopscope.task_lease (
  task   text PRIMARY KEY,
  owner  text,
  until  timestamptz,
  hold_s double precision CHECK (hold_s BETWEEN 1 AND 86400),
  CONSTRAINT task_lease_whole CHECK (num_nulls(owner, until, hold_s) IN (0, 3))
);
COMMENT ON TABLE loopscope.task_lease IS 'Work for all loops together that one worker at a time does, one row each';
COMMENT ON COLUMN loopscope.task_lease.task IS 'plant_round (held by a lease) or announce_flags (locked for one transaction, never leased)';
COMMENT ON COLUMN loopscope.task_lease.owner IS 'Worker that is at it, host/pid; null = nobody';
COMMENT ON COLUMN loopscope.task_lease.until IS 'When its lease ends (the database''s clock)';
COMMENT ON COLUMN loopscope.task_lease.hold_s IS 'Seconds that the lease was given for: one that would end later than these from now comes of a clock that was ahead, and does not hold';
INSERT INTO loopscope.task_lease (task) VALUES ('plant_round'), ('announce_flags');

-- A conflict locks the row, whatever its WHERE says: rows that stay as they are must not be touched, or an open transaction on
-- any column of loop keeps all of its loops from the workers.
CREATE OR REPLACE FUNCTION loopscope.follow_loop() RETURNS trigger LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
BEGIN
  INSERT INTO loopscope.schedule (loop_id, enabled)
  SELECT changed.loop_id, changed.enabled
  FROM changed LEFT JOIN loopscope.schedule AS kept USING (loop_id)
  WHERE kept.loop_id IS NULL OR kept.enabled <> changed.enabled
  ON CONFLICT (loop_id) DO UPDATE SET enabled = EXCLUDED.enabled;
  RETURN NULL;
END $$;

-- An annotation is taken back once, by whom and when the server says.
CREATE OR REPLACE FUNCTION loopscope.note_withdrawal() RETURNS trigger LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
BEGIN
  IF TG_OP = 'INSERT' THEN  -- as withdrawn already: the owner alone may, who brings in what was said elsewhere
    NEW.withdrawn_by := CASE WHEN NEW.withdrawn_at IS NOT NULL THEN coalesce(NEW.withdrawn_by, session_user) END;
  ELSIF OLD.withdrawn_at IS NOT NULL THEN
    RAISE EXCEPTION 'annotation % was taken back already', OLD.annotation_id USING ERRCODE = 'check_violation',
      DETAIL = format('by %s at %s', coalesce(OLD.withdrawn_by, 'somebody'), OLD.withdrawn_at),
      HINT = 'what is to hold again is said in a new annotation';
  ELSIF NEW.withdrawn_at IS NOT NULL THEN
    NEW.withdrawn_at := clock_timestamp();
    NEW.withdrawn_by := session_user;
  END IF;
  RETURN NEW;
END $$;
COMMENT ON FUNCTION loopscope.note_withdrawal() IS 'Notes who takes an annotation back, and when; what was taken back stays so';

-- Months that maintain makes are read by whoever reads the whole: pg_dump asks for each table by itself.
CREATE OR REPLACE FUNCTION loopscope.new_partition_table(parent text, partition text, described text)
RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
DECLARE reader text;
BEGIN
  EXECUTE format('CREATE TABLE loopscope.%I (LIKE loopscope.%I INCLUDING ALL)', partition, parent);
  EXECUTE format('COMMENT ON TABLE loopscope.%I IS %L', partition, described);
  FOR reader IN
    SELECT granted.grantee::regrole FROM pg_class AS class CROSS JOIN aclexplode(class.relacl) AS granted
    WHERE class.oid = format('loopscope.%I', parent)::regclass
      AND granted.privilege_type = 'SELECT' AND granted.grantee NOT IN (0, class.relowner)
  LOOP
    EXECUTE format('GRANT SELECT ON loopscope.%I TO %s', partition, reader);
  END LOOP;
END $$;
COMMENT ON FUNCTION loopscope.new_partition_table(text, text, text) IS 'An empty table that can become a partition of parent, read by whoever reads that';

-- All rights in one place again (storage/README.md, "Roles", is the list, and a test compares). Whatever else the groups were
-- given is taken back; nobody sees the moment between, because it is one transaction. The worker's UPDATE leaves out every key,
-- so that no row of results can be passed off as another's, and holds no lock that stops readers.
CREATE OR REPLACE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
DECLARE
  grantee text;
  written record;
BEGIN
  FOREACH grantee IN ARRAY '{PUBLIC,loopscope_historian,loopscope_worker,loopscope_reader,loopscope_engineer}'::text[] LOOP
    CONTINUE WHEN grantee <> 'PUBLIC' AND to_regrole(grantee) IS NULL;
    EXECUTE 'REVOKE ALL ON SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL TABLES IN SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL SEQUENCES IN SCHEMA loopscope FROM ' || grantee;
    EXECUTE 'REVOKE ALL ON ALL FUNCTIONS IN SCHEMA loopscope FROM ' || grantee;
    CONTINUE WHEN grantee IN ('PUBLIC', 'loopscope_historian');
    EXECUTE 'GRANT USAGE ON SCHEMA loopscope TO ' || grantee;
    EXECUTE 'GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO ' || grantee;
    -- What views call is called with the rights of whoever asks.
    EXECUTE 'GRANT EXECUTE ON FUNCTION loopscope.verdict_run, loopscope.flagged_at, loopscope.oldest_program TO ' || grantee;
  END LOOP;
  IF to_regrole('loopscope_reader') IS NOT NULL THEN
    GRANT SELECT ON ALL SEQUENCES IN SCHEMA loopscope TO loopscope_reader;  -- for pg_dump
  END IF;
  IF to_regrole('loopscope_engineer') IS NOT NULL THEN
    -- Without author and entered_at: who said it, and when, is the server's to note.
    GRANT INSERT (loop_id, kind, code, until, reason), UPDATE (withdrawn_at) ON loopscope.annotation TO loopscope_engineer;
    GRANT INSERT (loop_id, done_at, kind, description) ON loopscope.maintenance_event TO loopscope_engineer;
  END IF;
  IF to_regrole('loopscope_worker') IS NOT NULL THEN
    GRANT UPDATE (visible_at, owner, fence, attempts, lost_leases, last_error, last_slot_end, result_slot_end)
      ON loopscope.schedule TO loopscope_worker;
    GRANT UPDATE (value) ON loopscope.parameter TO loopscope_worker;
    GRANT UPDATE (owner, until, hold_s) ON loopscope.task_lease TO loopscope_worker;
    GRANT UPDATE (status, confirmed_at, ended_at, ended_by) ON loopscope.flag_notice TO loopscope_worker;
    GRANT INSERT ON loopscope.analysis, loopscope.bicoherence_peak, loopscope.explanation_step, loopscope.verdict,
      loopscope.plant_oscillation, loopscope.plant_round, loopscope.standing_problem, loopscope.stage_cost,
      loopscope.worker, loopscope.flag_notice TO loopscope_worker;
    FOR written IN
      SELECT class.relname, string_agg(quote_ident(part.attname), ', ' ORDER BY part.attnum) AS columns
      FROM pg_class AS class
      JOIN pg_attribute AS part ON part.attrelid = class.oid AND part.attnum > 0 AND NOT part.attisdropped
      WHERE class.relnamespace = 'loopscope'::regnamespace
        AND class.relname IN ('analysis', 'plant_oscillation', 'plant_round', 'standing_problem', 'stage_cost', 'worker')
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
DROP FUNCTION loopscope.grant_rights_of_0012();
