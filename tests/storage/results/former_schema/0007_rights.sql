-- Who may do what. `migrate` calls this every time, so a role that is created later gets its rights
-- with the next call. The worker deletes nothing and changes no table; a reader only reads.

CREATE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
BEGIN
  REVOKE ALL ON SCHEMA loopscope FROM PUBLIC;
  REVOKE ALL ON ALL FUNCTIONS IN SCHEMA loopscope FROM PUBLIC;
  IF to_regrole('loopscope_worker') IS NOT NULL THEN
    GRANT USAGE ON SCHEMA loopscope TO loopscope_worker;
    GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO loopscope_worker;
    GRANT UPDATE (visible_at, owner, fence, attempts, last_error, last_slot_end, result_slot_end)
      ON loopscope.schedule TO loopscope_worker;
    GRANT UPDATE (value) ON loopscope.parameter TO loopscope_worker;
    GRANT INSERT, UPDATE ON loopscope.analysis, loopscope.plant_oscillation TO loopscope_worker;
    GRANT INSERT ON loopscope.bicoherence_peak, loopscope.explanation_step, loopscope.verdict TO loopscope_worker;
    GRANT USAGE ON SEQUENCE loopscope.analysis_id TO loopscope_worker;
  END IF;
  IF to_regrole('loopscope_reader') IS NOT NULL THEN
    GRANT USAGE ON SCHEMA loopscope TO loopscope_reader;
    GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO loopscope_reader;
  END IF;
END $$;
COMMENT ON FUNCTION loopscope.grant_rights() IS 'Gives loopscope_worker and loopscope_reader, where they exist, exactly the rights that they need';
