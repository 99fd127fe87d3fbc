-- Where the time goes: per analysis, and per hour and lane of each host.

ALTER TABLE loopscope.analysis
  ADD COLUMN prepare_ms double precision,
  ADD COLUMN statistics_ms double precision,
  ADD COLUMN model_ms double precision;
COMMENT ON COLUMN loopscope.analysis.analyse_ms IS 'Time for the analysis, milliseconds: prepare_ms, statistics_ms, model_ms and the verdict';
COMMENT ON COLUMN loopscope.analysis.prepare_ms IS 'Time for masks, gaps, archive and oscillation, milliseconds';
COMMENT ON COLUMN loopscope.analysis.statistics_ms IS 'Time for the higher-order statistics, shapes and performance, milliseconds';
COMMENT ON COLUMN loopscope.analysis.model_ms IS 'Time for the loop model, milliseconds; null = none was fitted';

-- A partition's columns have comments of their own.
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT part.inhrelid::regclass AS name, own.attname, col_description(part.inhparent, whole.attnum) AS words
    FROM pg_inherits AS part
    JOIN pg_attribute AS own ON own.attrelid = part.inhrelid AND own.attnum > 0 AND NOT own.attisdropped
    JOIN pg_attribute AS whole ON whole.attrelid = part.inhparent AND whole.attname = own.attname
    WHERE part.inhparent = 'loopscope.analysis'::regclass AND col_description(part.inhrelid, own.attnum) IS NULL
  LOOP
    EXECUTE format('COMMENT ON COLUMN %s.%I IS %L', missing.name, missing.attname, missing.words);
  END LOOP;
END $$;

CREATE TABLE loopscope.stage_cost (
  hour         timestamptz NOT NULL,
  host         text NOT NULL,
  lane         integer NOT NULL,
  loops        bigint NOT NULL,
  analysed     bigint NOT NULL,
  modelled     bigint NOT NULL,
  sample_values bigint NOT NULL,
  claim_s      double precision NOT NULL,
  fetch_s      double precision NOT NULL,
  prepare_s    double precision NOT NULL,
  statistics_s double precision NOT NULL,
  model_s      double precision NOT NULL,
  decide_s     double precision NOT NULL,
  write_s      double precision NOT NULL,
  wait_s       double precision NOT NULL,
  PRIMARY KEY (hour, host, lane)
) WITH (fillfactor = 50);
COMMENT ON TABLE loopscope.stage_cost IS 'Where the time of the workers went, per hour, host and lane (a lane fetches, analyses and writes one batch of loops after the other)';
COMMENT ON COLUMN loopscope.stage_cost.hour IS 'Start of the hour, by the database''s clock';
COMMENT ON COLUMN loopscope.stage_cost.host IS 'Host of the workers';
COMMENT ON COLUMN loopscope.stage_cost.lane IS 'Number of the lane in its process; processes of one host share the rows';
COMMENT ON COLUMN loopscope.stage_cost.loops IS 'Loops brought to their end, unchanged and set aside ones included';
COMMENT ON COLUMN loopscope.stage_cost.analysed IS 'Windows that were analysed anew';
COMMENT ON COLUMN loopscope.stage_cost.modelled IS 'Of those, windows with a loop model';
COMMENT ON COLUMN loopscope.stage_cost.sample_values IS 'Values in the windows that were read';
COMMENT ON COLUMN loopscope.stage_cost.claim_s IS 'Seconds for taking loops from the schedule and asking what is stored of them';
COMMENT ON COLUMN loopscope.stage_cost.fetch_s IS 'Seconds for rows out of the historians, waiting for a connection included';
COMMENT ON COLUMN loopscope.stage_cost.prepare_s IS 'Seconds for masks, gaps, archive and oscillation';
COMMENT ON COLUMN loopscope.stage_cost.statistics_s IS 'Seconds for the higher-order statistics, shapes and performance';
COMMENT ON COLUMN loopscope.stage_cost.model_s IS 'Seconds for the loop model';
COMMENT ON COLUMN loopscope.stage_cost.decide_s IS 'Seconds for verdicts, digests and JSON';
COMMENT ON COLUMN loopscope.stage_cost.write_s IS 'Seconds for rows into the results';
COMMENT ON COLUMN loopscope.stage_cost.wait_s IS 'Seconds of waiting for a core that is free to analyse';

CREATE VIEW loopscope.stage_breakdown AS
  SELECT hour, host, count(*) AS lanes, sum(loops)::bigint AS loops, sum(analysed)::bigint AS analysed,
         sum(modelled)::bigint AS modelled,
         1000 * sum(claim_s) / nullif(sum(loops), 0) AS claim_ms,
         1000 * sum(fetch_s) / nullif(sum(loops), 0) AS fetch_ms,
         1000 * sum(prepare_s) / nullif(sum(loops), 0) AS prepare_ms,
         1000 * sum(statistics_s) / nullif(sum(loops), 0) AS statistics_ms,
         1000 * sum(model_s) / nullif(sum(loops), 0) AS model_ms,
         1000 * sum(decide_s) / nullif(sum(loops), 0) AS decide_ms,
         1000 * sum(write_s) / nullif(sum(loops), 0) AS write_ms,
         1000 * sum(wait_s) / nullif(sum(loops), 0) AS wait_ms,
         1000 * sum(model_s) / nullif(sum(modelled), 0) AS ms_per_model
  FROM loopscope.stage_cost GROUP BY hour, host;
COMMENT ON VIEW loopscope.stage_breakdown IS 'Milliseconds a loop in each stage, per hour and host';
COMMENT ON COLUMN loopscope.stage_breakdown.hour IS 'Start of the hour, by the database''s clock';
COMMENT ON COLUMN loopscope.stage_breakdown.host IS 'Host of the workers';
COMMENT ON COLUMN loopscope.stage_breakdown.lanes IS 'Lanes that worked in this hour';
COMMENT ON COLUMN loopscope.stage_breakdown.loops IS 'Loops brought to their end, unchanged and set aside ones included';
COMMENT ON COLUMN loopscope.stage_breakdown.analysed IS 'Windows that were analysed anew';
COMMENT ON COLUMN loopscope.stage_breakdown.modelled IS 'Of those, windows with a loop model';
COMMENT ON COLUMN loopscope.stage_breakdown.claim_ms IS 'Milliseconds a loop for taking it from the schedule';
COMMENT ON COLUMN loopscope.stage_breakdown.fetch_ms IS 'Milliseconds a loop for its rows out of the historian, waiting for a connection included';
COMMENT ON COLUMN loopscope.stage_breakdown.prepare_ms IS 'Milliseconds a loop for masks, gaps, archive and oscillation';
COMMENT ON COLUMN loopscope.stage_breakdown.statistics_ms IS 'Milliseconds a loop for the higher-order statistics, shapes and performance';
COMMENT ON COLUMN loopscope.stage_breakdown.model_ms IS 'Milliseconds a loop for the loop model, spread over all loops';
COMMENT ON COLUMN loopscope.stage_breakdown.decide_ms IS 'Milliseconds a loop for verdict, digest and JSON';
COMMENT ON COLUMN loopscope.stage_breakdown.write_ms IS 'Milliseconds a loop for its rows into the results';
COMMENT ON COLUMN loopscope.stage_breakdown.wait_ms IS 'Milliseconds a loop of waiting for a core that is free to analyse';
COMMENT ON COLUMN loopscope.stage_breakdown.ms_per_model IS 'Milliseconds for one loop model; null = none was fitted';

CREATE OR REPLACE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
BEGIN
  REVOKE ALL ON SCHEMA loopscope FROM PUBLIC;
  REVOKE ALL ON ALL FUNCTIONS IN SCHEMA loopscope FROM PUBLIC;
  IF to_regrole('loopscope_worker') IS NOT NULL THEN
    GRANT USAGE ON SCHEMA loopscope TO loopscope_worker;
    GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO loopscope_worker;
    GRANT UPDATE (visible_at, owner, fence, attempts, last_error, last_slot_end, result_slot_end)
      ON loopscope.schedule TO loopscope_worker;
    GRANT UPDATE (value) ON loopscope.parameter TO loopscope_worker;
    GRANT INSERT, UPDATE ON loopscope.analysis, loopscope.plant_oscillation, loopscope.standing_problem,
      loopscope.stage_cost TO loopscope_worker;
    GRANT INSERT ON loopscope.bicoherence_peak, loopscope.explanation_step, loopscope.verdict TO loopscope_worker;
    GRANT USAGE ON SEQUENCE loopscope.analysis_id TO loopscope_worker;
  END IF;
  IF to_regrole('loopscope_reader') IS NOT NULL THEN
    GRANT USAGE ON SCHEMA loopscope TO loopscope_reader;
    GRANT SELECT ON ALL TABLES IN SCHEMA loopscope TO loopscope_reader;
  END IF;
END $$;

CREATE OR REPLACE FUNCTION loopscope.delete_old_rows(before timestamptz) RETURNS void LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
DECLARE parent text;
BEGIN
  FOREACH parent IN ARRAY loopscope.partitioned_tables() LOOP
    EXECUTE format('DELETE FROM loopscope.%I WHERE slot_end < %L', parent || '_default', before);
  END LOOP;
  DELETE FROM loopscope.plant_oscillation WHERE slot_end < before;
  DELETE FROM loopscope.stage_cost WHERE hour < before;
END $$;
