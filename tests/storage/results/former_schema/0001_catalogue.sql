-- The schema itself, what it was brought up to date with, the loops and when each is due.

CREATE SCHEMA IF NOT EXISTS loopscope;
COMMENT ON SCHEMA loopscope IS 'Control-loop diagnoses: loops, schedule, analyses, verdicts and views for people';

CREATE TABLE loopscope.schema_migration (
  version    integer PRIMARY KEY,
  name       text NOT NULL UNIQUE,
  sha256     text NOT NULL,
  applied_at timestamptz NOT NULL DEFAULT now()
);
COMMENT ON TABLE loopscope.schema_migration IS 'The migrations that made this schema, one row each';
COMMENT ON COLUMN loopscope.schema_migration.version IS 'Number of the migration; the highest one is the schema version';
COMMENT ON COLUMN loopscope.schema_migration.name IS 'File name of the migration without its ending';
COMMENT ON COLUMN loopscope.schema_migration.sha256 IS 'SHA-256 of the migration''s text when it was applied, 64 hexadecimal digits';
COMMENT ON COLUMN loopscope.schema_migration.applied_at IS 'When it was applied';

CREATE TABLE loopscope.parameter (
  name        text PRIMARY KEY,
  value       double precision NOT NULL,
  unit        text NOT NULL,
  description text NOT NULL
);
COMMENT ON TABLE loopscope.parameter IS 'Numbers that the views compute with; those without weight_ follow the settings file, the weights are the site''s to change';
COMMENT ON COLUMN loopscope.parameter.name IS 'Name of the parameter';
COMMENT ON COLUMN loopscope.parameter.value IS 'Its value in `unit`';
COMMENT ON COLUMN loopscope.parameter.unit IS 'Unit of the value, with its range';
COMMENT ON COLUMN loopscope.parameter.description IS 'What the parameter does';

INSERT INTO loopscope.parameter (name, value, unit, description) VALUES
  ('false_discovery_rate', 0.05, 'share, 0 to 1', 'Expected share of false ones among the loops that are flagged on a test'),
  ('false_discovery_dependence', 0, '0 or 1', '0 = the tests of different loops are independent or rise together (Benjamini, Hochberg); 1 = they hang together in any way (Benjamini, Yekutieli)'),
  ('min_confidence', 0.3, 'share, 0 to 1', 'Verdicts with a lower confidence are not flagged'),
  ('weight_valve_stiction', 1.0, 'factor, > 0', 'Rank of the fault: a repair at one valve ends it'),
  ('weight_valve_deadband', 0.8, 'factor, > 0', 'Rank of the fault: a repair at one valve ends it'),
  ('weight_valve_saturation', 0.9, 'factor, > 0', 'Rank of the fault: the loop is out of control while it lasts'),
  ('weight_valve_characteristic', 0.7, 'factor, > 0', 'Rank of the fault: needs a new trim or a characteriser'),
  ('weight_valve_oversized', 0.6, 'factor, > 0', 'Rank of the fault: needs a smaller valve at the next shutdown'),
  ('weight_process_nonlinearity', 0.6, 'factor, > 0', 'Rank of the fault: needs gain scheduling'),
  ('weight_external_disturbance', 0.5, 'factor, > 0', 'Rank of the fault: its cause lies elsewhere'),
  ('weight_process_change', 0.6, 'factor, > 0', 'Rank of the fault: the tuning no longer fits'),
  ('weight_sensor_fault', 1.0, 'factor, > 0', 'Rank of the fault: everything else rests on the sensor'),
  ('weight_tight_tuning', 0.7, 'factor, > 0', 'Rank of the fault: mended by retuning'),
  ('weight_sluggish_tuning', 0.4, 'factor, > 0', 'Rank of the fault: mended by retuning, rarely urgent'),
  ('weight_nonlinear_unexplained', 0.5, 'factor, > 0', 'Rank of the fault: real, but its cause is not known yet'),
  ('weight_unexplained', 0.3, 'factor, > 0', 'Rank of the fault: its cause is not known yet');

CREATE TABLE loopscope.loop (
  loop_id       bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  name          text NOT NULL UNIQUE CHECK (name <> ''),
  source        text NOT NULL CHECK (source <> ''),
  sp_tag        text CHECK (sp_tag <> ''),
  pv_tag        text NOT NULL CHECK (pv_tag <> ''),
  op_tag        text CHECK (op_tag <> ''),
  mv_tag        text CHECK (mv_tag <> ''),
  mode_tag      text CHECK (mode_tag <> ''),
  interval_s    double precision CHECK (interval_s BETWEEN 0.001 AND 86400),
  period_s      double precision NOT NULL CHECK (period_s BETWEEN 1 AND 2592000),
  op_low        double precision,
  op_high       double precision,
  loop_type     text CHECK (loop_type <> ''),
  importance    double precision NOT NULL DEFAULT 1 CHECK (importance > 0 AND importance < 'infinity'),
  enabled       boolean NOT NULL DEFAULT true,
  registered_at timestamptz NOT NULL DEFAULT now(),
  changed_at    timestamptz NOT NULL DEFAULT now(),
  CONSTRAINT loop_op_range CHECK ((op_low IS NULL) = (op_high IS NULL) AND (op_low IS NULL OR op_low < op_high))
);
COMMENT ON TABLE loopscope.loop IS 'The catalogue: one row per control loop';
COMMENT ON COLUMN loopscope.loop.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.loop.name IS 'Unique name that people use';
COMMENT ON COLUMN loopscope.loop.source IS 'Name of a historian in the settings file';
COMMENT ON COLUMN loopscope.loop.sp_tag IS 'Historian tag of the setpoint; null = not recorded';
COMMENT ON COLUMN loopscope.loop.pv_tag IS 'Historian tag of the process variable';
COMMENT ON COLUMN loopscope.loop.op_tag IS 'Historian tag of the controller output; null = not recorded';
COMMENT ON COLUMN loopscope.loop.mv_tag IS 'Historian tag of the measured valve position; null = not recorded';
COMMENT ON COLUMN loopscope.loop.mode_tag IS 'Historian tag of the controller mode; null = not recorded';
COMMENT ON COLUMN loopscope.loop.interval_s IS 'Sample interval in seconds; null = found from the rows';
COMMENT ON COLUMN loopscope.loop.period_s IS 'Seconds between two analyses';
COMMENT ON COLUMN loopscope.loop.op_low IS 'Controller output at 0 %, in its own units; null = range unknown';
COMMENT ON COLUMN loopscope.loop.op_high IS 'Controller output at 100 %, in its own units; null = range unknown';
COMMENT ON COLUMN loopscope.loop.loop_type IS 'flow, pressure, level, temperature, ...; null = not said';
COMMENT ON COLUMN loopscope.loop.importance IS 'Weight of the loop in the ranking, 1 = ordinary';
COMMENT ON COLUMN loopscope.loop.enabled IS 'Whether the loop is analysed';
COMMENT ON COLUMN loopscope.loop.registered_at IS 'When the loop was added';
COMMENT ON COLUMN loopscope.loop.changed_at IS 'When its row was changed last';

-- One column, visible_at, says both when a loop is due and until when a worker holds it: a claim
-- pushes it into the future, so that claimed loops leave the head of the index by themselves and a
-- lost worker's loops come back without anybody's help. Every claim and completion rewrites the
-- row: hence room on the page and an early vacuum.
CREATE TABLE loopscope.schedule (
  loop_id         bigint PRIMARY KEY REFERENCES loopscope.loop ON DELETE CASCADE,
  enabled         boolean NOT NULL,
  visible_at      timestamptz NOT NULL DEFAULT now() CHECK (isfinite(visible_at)),
  owner           text,
  fence           bigint NOT NULL DEFAULT 0,
  attempts        integer NOT NULL DEFAULT 0,
  last_error      text,
  last_slot_end   timestamptz,
  result_slot_end timestamptz
) WITH (fillfactor = 70, autovacuum_vacuum_scale_factor = 0.01);
CREATE INDEX schedule_due ON loopscope.schedule (visible_at) WHERE enabled;
COMMENT ON TABLE loopscope.schedule IS 'When each loop is looked at next and who holds it; one row per loop, kept by triggers on loop';
COMMENT ON COLUMN loopscope.schedule.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.schedule.enabled IS 'Copy of loop.enabled, so that the index of due loops holds no disabled ones';
COMMENT ON COLUMN loopscope.schedule.visible_at IS 'When the loop is due, or, with an owner, when the owner''s lease ends (the database''s clock)';
COMMENT ON COLUMN loopscope.schedule.owner IS 'Worker that holds the loop; null = nobody';
COMMENT ON COLUMN loopscope.schedule.fence IS 'Rises with every claim; a result with an older fence is refused';
COMMENT ON COLUMN loopscope.schedule.attempts IS 'Failures in a row, lost leases included';
COMMENT ON COLUMN loopscope.schedule.last_error IS 'What the last failure was; null after a success';
COMMENT ON COLUMN loopscope.schedule.last_slot_end IS 'Newest slot that was completed, with or without a new row';
COMMENT ON COLUMN loopscope.schedule.result_slot_end IS 'Newest slot that has a stored analysis: where latest_verdict looks';

-- Per statement: a catalogue of a hundred thousand loops is saved at once.
CREATE FUNCTION loopscope.follow_loop() RETURNS trigger LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
BEGIN
  INSERT INTO loopscope.schedule AS kept (loop_id, enabled) SELECT loop_id, enabled FROM changed
  ON CONFLICT (loop_id) DO UPDATE SET enabled = EXCLUDED.enabled WHERE kept.enabled <> EXCLUDED.enabled;
  RETURN NULL;
END $$;
COMMENT ON FUNCTION loopscope.follow_loop() IS 'Gives every loop its schedule row and keeps schedule.enabled equal to loop.enabled';
CREATE TRIGGER follow_inserted AFTER INSERT ON loopscope.loop
  REFERENCING NEW TABLE AS changed FOR EACH STATEMENT EXECUTE FUNCTION loopscope.follow_loop();
CREATE TRIGGER follow_updated AFTER UPDATE ON loopscope.loop
  REFERENCING NEW TABLE AS changed FOR EACH STATEMENT EXECUTE FUNCTION loopscope.follow_loop();
