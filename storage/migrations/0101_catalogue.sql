-- The schema itself, the loops and when each is due, who works on them, and what they work by.

CREATE SCHEMA IF NOT EXISTS loopscope;
COMMENT ON SCHEMA loopscope IS 'Control-loop diagnoses: loops, schedule, analyses, verdicts and views for people';

-- Compiling a query on the views takes up to tens of seconds, running it a fraction of one. A database of our own is
-- told not to; of others, deploy/roles.sql does, or their owner (storage/results/schema/README.md).
DO $$
BEGIN
  IF EXISTS (SELECT FROM pg_database WHERE datname = current_database() AND datdba = current_user::regrole) THEN
    EXECUTE format('ALTER DATABASE %I SET jit = off', current_database());
  END IF;
END $$;

CREATE TABLE loopscope.schema_migration (
  version    integer PRIMARY KEY,
  name       text NOT NULL UNIQUE,
  sha256     text NOT NULL,
  applied_at timestamptz NOT NULL DEFAULT now()
);
COMMENT ON TABLE loopscope.schema_migration IS 'The migrations that made this schema, one row each';
COMMENT ON COLUMN loopscope.schema_migration.version IS
  'Number of the migration; the highest one is the schema version';
COMMENT ON COLUMN loopscope.schema_migration.name IS 'File name of the migration without its ending';
COMMENT ON COLUMN loopscope.schema_migration.sha256 IS
  'SHA-256 of the migration''s text when it was applied, 64 hexadecimal digits';
COMMENT ON COLUMN loopscope.schema_migration.applied_at IS 'When it was applied';

-- Expand, then contract: a program works on a newer schema as long as that was only added to. A migration that takes
-- something away which programs of schema version N still use replaces this function by one that returns N + 1.
CREATE FUNCTION loopscope.oldest_program() RETURNS integer IMMUTABLE LANGUAGE sql RETURN 12;
COMMENT ON FUNCTION loopscope.oldest_program() IS 'The lowest schema version whose programs still work on this schema';

-- Of the figures that views compute with a worker may set any: one beyond all sense must not stop a view.
CREATE TABLE loopscope.parameter (
  name        text PRIMARY KEY,
  value       double precision NOT NULL,
  unit        text NOT NULL,
  description text NOT NULL,
  CONSTRAINT parameter_value CHECK (abs(value) <= 1000000)
);
COMMENT ON TABLE loopscope.parameter IS
  'Numbers that the views compute with; false_discovery_rate, false_discovery_dependence and min_confidence follow '
  'the settings file, the others are the site''s to change';
COMMENT ON COLUMN loopscope.parameter.name IS 'Name of the parameter';
COMMENT ON COLUMN loopscope.parameter.value IS 'Its value in `unit`';
COMMENT ON COLUMN loopscope.parameter.unit IS 'Unit of the value, with its range';
COMMENT ON COLUMN loopscope.parameter.description IS 'What the parameter does';

-- The rate is the default of the settings file, which every worker writes here: at 0.05 one simulated plant of 500
-- loops in four has more than two false flags beside its 25 faults, and at 0.005 no fault is lost
-- (tests/plants/README.md).
INSERT INTO loopscope.parameter (name, value, unit, description) VALUES
  ('false_discovery_rate', 0.005, 'share, 0 to 1',
   'Expected share of false ones among the loops that are flagged on a test'),
  ('false_discovery_dependence', 0, '0 or 1',
   '0 = the tests of different loops are independent or rise together (Benjamini, Hochberg); 1 = they hang together '
   'in any way (Benjamini, Yekutieli)'),
  ('min_confidence', 0.3, 'share, 0 to 1', 'Verdicts with a lower confidence are not flagged'),
  ('plant_round_valid_days', 7, 'days, > 0',
   'A verdict that is so much newer than the newest plant round is not hidden by it'),
  ('flag_quiet_hours', 24, 'hours, >= 0',
   'A loop that is flagged again so soon after the same flag ended is not announced again'),
  ('list_false_share', 0.02, 'share, 0 to 1',
   'Expected share of loops without a fault among those on the list: the mean of 1 - fault_probability'),
  ('list_enough_windows', 2, 'windows, > 0',
   'From so many windows on that share no sample the odds of all of them decide whether a loop enters the list; '
   'before, evidence as strong has to be rare as well'),
  ('list_leave_share', 0.2, 'share, 0 to 1',
   'A loop that is on the list stays until the mean of 1 - fault_probability over those that are as probable or more '
   'exceeds this, or its fault_probability falls below min_confidence'),
  ('list_least_probability', 0.8, 'probability, 0 to 1',
   'fault_probability that a loop enters the list with, at least: behind many sure faults the mean of 1 - '
   'fault_probability alone would take in what is hardly more likely a fault than not'),
  ('list_leave_probability', 0.5, 'probability, 0 to 1',
   'fault_probability below which a loop leaves the list: behind many sure faults the mean of 1 - fault_probability '
   'alone would keep a loop that has been mended'),
  ('weight_valve_stiction', 1, 'factor, > 0', 'Rank of the fault: a repair at one valve ends it'),
  ('weight_valve_deadband', 0.8, 'factor, > 0', 'Rank of the fault: a repair at one valve ends it'),
  ('weight_valve_saturation', 0.9, 'factor, > 0', 'Rank of the fault: the loop is out of control while it lasts'),
  ('weight_valve_characteristic', 0.7, 'factor, > 0', 'Rank of the fault: needs a new trim or a characteriser'),
  ('weight_valve_oversized', 0.6, 'factor, > 0', 'Rank of the fault: needs a smaller valve at the next shutdown'),
  ('weight_process_nonlinearity', 0.6, 'factor, > 0', 'Rank of the fault: needs gain scheduling'),
  ('weight_external_disturbance', 0.5, 'factor, > 0', 'Rank of the fault: its cause lies elsewhere'),
  ('weight_process_change', 0.6, 'factor, > 0', 'Rank of the fault: the tuning no longer fits'),
  ('weight_sensor_fault', 1, 'factor, > 0', 'Rank of the fault: everything else rests on the sensor'),
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
  area          text CHECK (area <> ''),
  unit          text CHECK (unit <> ''),
  description   text CHECK (description <> ''),
  pv_unit       text CHECK (pv_unit <> ''),
  owner         text CHECK (owner <> ''),
  pv_low        double precision,
  pv_high       double precision,
  CONSTRAINT loop_op_range CHECK ((op_low IS NULL) = (op_high IS NULL) AND (op_low IS NULL OR op_low < op_high)),
  CONSTRAINT loop_pv_range CHECK ((pv_low IS NULL) = (pv_high IS NULL) AND (pv_low IS NULL OR pv_low < pv_high))
);
CREATE INDEX loop_period ON loopscope.loop (period_s) WHERE enabled;
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
COMMENT ON COLUMN loopscope.loop.area IS 'Area of the plant; null = not said';
COMMENT ON COLUMN loopscope.loop.unit IS 'Process unit within the area; null = not said';
COMMENT ON COLUMN loopscope.loop.description IS 'What the loop controls, in words; null = not said';
COMMENT ON COLUMN loopscope.loop.pv_unit IS 'Unit of sp and pv, such as m3/h; null = not said';
COMMENT ON COLUMN loopscope.loop.owner IS 'Who looks after the loop; null = not said';
COMMENT ON COLUMN loopscope.loop.pv_low IS 'pv at 0 % of its transmitter; null = range unknown';
COMMENT ON COLUMN loopscope.loop.pv_high IS 'pv at 100 % of its transmitter; null = range unknown';

-- One column, visible_at, says both when a loop is due and until when a worker holds it: a claim pushes it into the
-- future, so that claimed loops leave the head of the index by themselves and a lost worker's loops come back without
-- anybody's help. Every claim and completion rewrites the row: hence an early vacuum. No room is kept on the page,
-- since every update changes an indexed column and none stays within its page. Under an old snapshot (a dump, an open
-- transaction of a reader) every version of a row that an update has left behind stays, and so does its entry in each
-- index: what a claim or a completion looks up must not lie behind them. By the loop alone all versions of one loop
-- had the same key, and the look for a duplicate at each update would pass all of them; with the fence, which rises
-- with each claim, a key has two or three. That a loop has one row is the work of a trigger then (0105). And a value
-- that a claim cannot add to, or read, would stop every batch that it is in.
CREATE TABLE loopscope.schedule (
  loop_id         bigint NOT NULL REFERENCES loopscope.loop ON DELETE CASCADE,
  enabled         boolean NOT NULL,
  visible_at      timestamptz NOT NULL DEFAULT now() CHECK (isfinite(visible_at)),
  owner           text,
  fence           bigint NOT NULL DEFAULT 0,
  attempts        integer NOT NULL DEFAULT 0,
  last_error      text,
  last_slot_end   timestamptz,
  result_slot_end timestamptz,
  -- attempts counts every failure; a loop that takes its worker down with it needs more than a pause: it must not be
  -- claimed together with others. Failures that a worker survived do not count here.
  lost_leases     integer NOT NULL DEFAULT 0,
  -- So that a claim whose clock was ahead can be told from one that holds.
  hold_s          double precision CHECK (hold_s > 0 AND hold_s < 'infinity'),
  -- What the next window has to know of those before it. Not in the analyses: a claim waits for none of their locks.
  pv_flat_s       double precision,
  pv_step         double precision,
  PRIMARY KEY (loop_id, fence),
  CONSTRAINT schedule_fence CHECK (fence >= 0),
  CONSTRAINT schedule_attempts CHECK (attempts BETWEEN 0 AND 1000000),
  CONSTRAINT schedule_lost_leases CHECK (lost_leases BETWEEN 0 AND 1000000),
  -- A claim that was made for ages ends in its time as well; beyond what an interval holds the sum would stop all.
  CONSTRAINT schedule_hold_s CHECK (hold_s <= 1000000),
  -- Microseconds of later years are beyond a bigint.
  CONSTRAINT schedule_last_slot_end CHECK (isfinite(last_slot_end) AND last_slot_end < '294000-01-01+00'),
  CONSTRAINT schedule_result_slot_end CHECK (isfinite(result_slot_end) AND result_slot_end < '294000-01-01+00')
) WITH (autovacuum_vacuum_scale_factor = 0.01);
-- Loops of one period are due in the same instant: with loop_id behind it, a scan can begin between them.
CREATE INDEX schedule_due ON loopscope.schedule (visible_at, loop_id) WHERE enabled;
-- What is looked for at every poll and is rare has an index of its own, small and with nothing dead at its head.
CREATE INDEX schedule_suspect ON loopscope.schedule (visible_at) WHERE enabled AND lost_leases >= 2;
CREATE INDEX schedule_held ON loopscope.schedule (visible_at) WHERE enabled AND owner IS NOT NULL;
CREATE INDEX schedule_failing ON loopscope.schedule (loop_id) WHERE enabled AND attempts > 0;
CREATE INDEX schedule_ahead ON loopscope.schedule (loop_id)
  WHERE enabled AND (last_slot_end > visible_at OR result_slot_end > visible_at);
COMMENT ON TABLE loopscope.schedule IS
  'When each loop is looked at next and who holds it; one row per loop, kept by triggers on loop';
COMMENT ON COLUMN loopscope.schedule.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.schedule.enabled IS
  'Copy of loop.enabled, so that the index of due loops holds no disabled ones';
COMMENT ON COLUMN loopscope.schedule.visible_at IS
  'When the loop is due, or, with an owner, when the owner''s lease ends (the database''s clock)';
COMMENT ON COLUMN loopscope.schedule.owner IS 'Worker that holds the loop; null = nobody';
COMMENT ON COLUMN loopscope.schedule.fence IS 'Rises with every claim; a result with an older fence is refused';
COMMENT ON COLUMN loopscope.schedule.attempts IS 'Failures in a row, lost leases included';
COMMENT ON COLUMN loopscope.schedule.last_error IS 'What the last failure was; null after a success';
COMMENT ON COLUMN loopscope.schedule.last_slot_end IS 'Newest slot that was completed, with or without a new row';
COMMENT ON COLUMN loopscope.schedule.result_slot_end IS
  'Newest slot that has a stored analysis: where latest_verdict looks';
COMMENT ON COLUMN loopscope.schedule.lost_leases IS
  'Leases in a row that ended without a word of the worker; from the third on the loop is claimed alone, from the '
  'fourth on after growing pauses';
COMMENT ON COLUMN loopscope.schedule.hold_s IS
  'Seconds for which the last claim was made or prolonged; null = none yet, or by a program that does not note it';
COMMENT ON COLUMN loopscope.schedule.pv_flat_s IS
  'Longest run of equal values of pv that is usual for the loop, seconds, of all windows so far, without what stands '
  'still and should not; null = not known';
COMMENT ON COLUMN loopscope.schedule.pv_step IS 'Smallest usual step of pv, pv units; null = not known';

-- Per statement: a catalogue of a hundred thousand loops is saved at once. Rows that stay as they are must not be
-- touched, or an open transaction on any column of loop keeps all of its loops from the workers. A loop that is
-- enabled again is due now, not when it last was: nobody looks that far back.
CREATE FUNCTION loopscope.follow_loop() RETURNS trigger LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
BEGIN
  UPDATE loopscope.schedule AS kept SET
    enabled = changed.enabled,
    visible_at = CASE WHEN changed.enabled THEN greatest(kept.visible_at, now()) ELSE kept.visible_at END
  FROM changed WHERE kept.loop_id = changed.loop_id AND kept.enabled <> changed.enabled;
  INSERT INTO loopscope.schedule (loop_id, enabled)
  SELECT changed.loop_id, changed.enabled FROM changed
  WHERE NOT EXISTS (SELECT FROM loopscope.schedule AS kept WHERE kept.loop_id = changed.loop_id);
  RETURN NULL;
END $$;
COMMENT ON FUNCTION loopscope.follow_loop() IS
  'Gives every loop its schedule row and keeps schedule.enabled equal to loop.enabled';
CREATE TRIGGER follow_inserted AFTER INSERT ON loopscope.loop
  REFERENCING NEW TABLE AS changed FOR EACH STATEMENT EXECUTE FUNCTION loopscope.follow_loop();
CREATE TRIGGER follow_updated AFTER UPDATE ON loopscope.loop
  REFERENCING NEW TABLE AS changed FOR EACH STATEMENT EXECUTE FUNCTION loopscope.follow_loop();

-- Another tag is another signal.
CREATE FUNCTION loopscope.forget_pv() RETURNS trigger LANGUAGE plpgsql SET search_path = pg_catalog AS $$
BEGIN
  UPDATE loopscope.schedule SET pv_flat_s = NULL, pv_step = NULL WHERE loop_id = NEW.loop_id;
  RETURN NULL;
END $$;
COMMENT ON FUNCTION loopscope.forget_pv() IS 'Forgets what is known of pv where a loop gets another pv tag';
CREATE TRIGGER forget_pv AFTER UPDATE OF pv_tag, source ON loopscope.loop FOR EACH ROW
  WHEN (OLD.pv_tag <> NEW.pv_tag OR OLD.source <> NEW.source) EXECUTE FUNCTION loopscope.forget_pv();

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
COMMENT ON TABLE loopscope.worker IS
  'Processes that analyse, one row each; rows that nobody renews are removed by maintain';
COMMENT ON COLUMN loopscope.worker.worker IS 'host/pid, the beginning of schedule.owner';
COMMENT ON COLUMN loopscope.worker.program_version IS 'Version of the program';
COMMENT ON COLUMN loopscope.worker.algorithm_revision IS 'Revision of the analysis that it writes';
COMMENT ON COLUMN loopscope.worker.started_at IS 'When it spoke first';
COMMENT ON COLUMN loopscope.worker.last_seen IS 'When it spoke last: every third of a lease while it runs';
COMMENT ON COLUMN loopscope.worker.held_loops IS 'Loops in its hands at that time';
COMMENT ON COLUMN loopscope.worker.lost_leases IS 'Leases that it lost to others since its start';

-- Locks that decide something lie on rows that only a worker may lock: advisory locks are everybody's who may connect.
CREATE TABLE loopscope.task_lease (
  task   text PRIMARY KEY,
  owner  text,
  until  timestamptz,
  hold_s double precision CHECK (hold_s BETWEEN 1 AND 86400),
  CONSTRAINT task_lease_whole CHECK (num_nulls(owner, until, hold_s) IN (0, 3))
);
COMMENT ON TABLE loopscope.task_lease IS 'Work for all loops together that one worker at a time does, one row each';
COMMENT ON COLUMN loopscope.task_lease.task IS
  'plant_round (held by a lease) or announce_flags (locked for one transaction, never leased)';
COMMENT ON COLUMN loopscope.task_lease.owner IS 'Worker that is at it, host/pid; null = nobody';
COMMENT ON COLUMN loopscope.task_lease.until IS 'When its lease ends (the database''s clock)';
COMMENT ON COLUMN loopscope.task_lease.hold_s IS
  'Seconds that the lease was given for: one that would end later than these from now comes of a clock that was '
  'ahead, and does not hold';
INSERT INTO loopscope.task_lease (task) VALUES ('plant_round'), ('announce_flags');

-- What a person has said of clocks that differ (loopscope maintain --accept-clock).
CREATE TABLE loopscope.accepted_clock (
  clock       text PRIMARY KEY CHECK (clock <> ''),
  ahead_s     double precision NOT NULL CHECK (abs(ahead_s) < 'infinity'),
  accepted_at timestamptz NOT NULL DEFAULT now(),
  accepted_by text NOT NULL DEFAULT session_user
);
COMMENT ON TABLE loopscope.accepted_clock IS
  'Clocks that differ from the one of this server, which a person has called the right one; one row each';
COMMENT ON COLUMN loopscope.accepted_clock.clock IS '"host NAME" of a worker or "historian NAME" of the settings';
COMMENT ON COLUMN loopscope.accepted_clock.ahead_s IS
  'Seconds by which it was ahead of this server then, negative = behind; a difference that has changed since is not '
  'accepted';
COMMENT ON COLUMN loopscope.accepted_clock.accepted_at IS 'When it was said, by the clock of this server';
COMMENT ON COLUMN loopscope.accepted_clock.accepted_by IS 'Login of whoever said it';

CREATE TABLE loopscope.stage_cost (
  hour          timestamptz NOT NULL,
  host          text NOT NULL,
  lane          integer NOT NULL,
  loops         bigint NOT NULL,
  analysed      bigint NOT NULL,
  modelled      bigint NOT NULL,
  sample_values bigint NOT NULL,
  claim_s       double precision NOT NULL,
  fetch_s       double precision NOT NULL,
  prepare_s     double precision NOT NULL,
  statistics_s  double precision NOT NULL,
  model_s       double precision NOT NULL,
  decide_s      double precision NOT NULL,
  write_s       double precision NOT NULL,
  wait_s        double precision NOT NULL,
  PRIMARY KEY (hour, host, lane)
) WITH (fillfactor = 50);
COMMENT ON TABLE loopscope.stage_cost IS
  'Where the time of the workers went, per hour, host and lane (a lane fetches, analyses and writes one batch of '
  'loops after the other)';
COMMENT ON COLUMN loopscope.stage_cost.hour IS 'Start of the hour, by the database''s clock';
COMMENT ON COLUMN loopscope.stage_cost.host IS 'Host of the workers';
COMMENT ON COLUMN loopscope.stage_cost.lane IS
  'Number of the lane in its process; processes of one host share the rows';
COMMENT ON COLUMN loopscope.stage_cost.loops IS 'Loops brought to their end, unchanged and set aside ones included';
COMMENT ON COLUMN loopscope.stage_cost.analysed IS 'Windows that were analysed anew';
COMMENT ON COLUMN loopscope.stage_cost.modelled IS 'Of those, windows with a loop model';
COMMENT ON COLUMN loopscope.stage_cost.sample_values IS 'Values in the windows that were read';
COMMENT ON COLUMN loopscope.stage_cost.claim_s IS
  'Seconds for taking loops from the schedule and asking what is stored of them';
COMMENT ON COLUMN loopscope.stage_cost.fetch_s IS
  'Seconds for rows out of the historians, waiting for a connection included';
COMMENT ON COLUMN loopscope.stage_cost.prepare_s IS 'Seconds for masks, gaps, archive and oscillation';
COMMENT ON COLUMN loopscope.stage_cost.statistics_s IS
  'Seconds for the higher-order statistics, shapes and performance';
COMMENT ON COLUMN loopscope.stage_cost.model_s IS 'Seconds for the loop model';
COMMENT ON COLUMN loopscope.stage_cost.decide_s IS 'Seconds for verdicts, digests and JSON';
COMMENT ON COLUMN loopscope.stage_cost.write_s IS 'Seconds for rows into the results';
COMMENT ON COLUMN loopscope.stage_cost.wait_s IS 'Seconds of waiting for a core that is free to analyse';

-- What people did to a loop, and what they say of its verdict.
CREATE TABLE loopscope.maintenance_event (
  maintenance_event_id bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  loop_id              bigint NOT NULL REFERENCES loopscope.loop ON DELETE CASCADE,
  done_at              timestamptz NOT NULL CHECK (isfinite(done_at)),
  kind                 text NOT NULL CHECK (kind IN ('valve', 'sensor', 'tuning', 'process', 'other')),
  description          text NOT NULL CHECK (description <> ''),
  author               text NOT NULL DEFAULT session_user,
  entered_at           timestamptz NOT NULL DEFAULT now()
);
CREATE INDEX maintenance_event_of_loop ON loopscope.maintenance_event (loop_id, done_at);
COMMENT ON TABLE loopscope.maintenance_event IS
  'What people did to a loop; before_after_maintenance compares the analyses around it';
COMMENT ON COLUMN loopscope.maintenance_event.maintenance_event_id IS 'Number of the event';
COMMENT ON COLUMN loopscope.maintenance_event.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.maintenance_event.done_at IS 'When the work was finished';
COMMENT ON COLUMN loopscope.maintenance_event.kind IS 'valve, sensor, tuning, process or other';
COMMENT ON COLUMN loopscope.maintenance_event.description IS 'What was done';
COMMENT ON COLUMN loopscope.maintenance_event.author IS 'Who entered it';
COMMENT ON COLUMN loopscope.maintenance_event.entered_at IS 'When it was entered';

CREATE TABLE loopscope.annotation (
  annotation_id bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  loop_id       bigint NOT NULL REFERENCES loopscope.loop ON DELETE CASCADE,
  kind          text NOT NULL CHECK (kind IN ('acknowledged', 'suppressed', 'false_positive')),
  code          text,
  until         timestamptz,
  reason        text,
  author        text NOT NULL DEFAULT session_user,
  entered_at    timestamptz NOT NULL DEFAULT now(),
  withdrawn_at  timestamptz,
  withdrawn_by  text,
  CONSTRAINT annotation_suppression_ends CHECK (
    kind <> 'suppressed' OR (until IS NOT NULL AND isfinite(until) AND reason <> '' AND reason IS NOT NULL))
);
CREATE INDEX annotation_of_loop ON loopscope.annotation (loop_id);
COMMENT ON TABLE loopscope.annotation IS
  'What people said about a loop''s verdict; while one holds, the loop is not in flagged_loop';
COMMENT ON COLUMN loopscope.annotation.annotation_id IS 'Number of the annotation';
COMMENT ON COLUMN loopscope.annotation.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.annotation.kind IS
  'acknowledged (known, work is planned), suppressed (until a time, for a reason) or false_positive (the verdict is '
  'wrong)';
COMMENT ON COLUMN loopscope.annotation.code IS 'Verdict that it is about; null = whatever the verdict';
COMMENT ON COLUMN loopscope.annotation.until IS 'When it ends to hold; null = when it is withdrawn';
COMMENT ON COLUMN loopscope.annotation.reason IS 'Why; required to suppress';
COMMENT ON COLUMN loopscope.annotation.author IS 'Who entered it';
COMMENT ON COLUMN loopscope.annotation.entered_at IS 'When it was entered';
COMMENT ON COLUMN loopscope.annotation.withdrawn_at IS 'When it was taken back; null = it holds';
COMMENT ON COLUMN loopscope.annotation.withdrawn_by IS
  'Who took it back; null = it holds, or was taken back before this was noted';

-- An annotation is taken back once, by whom and when the server says.
CREATE FUNCTION loopscope.note_withdrawal() RETURNS trigger LANGUAGE plpgsql
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
COMMENT ON FUNCTION loopscope.note_withdrawal() IS
  'Notes who takes an annotation back, and when; what was taken back stays so';
CREATE TRIGGER note_withdrawal BEFORE INSERT OR UPDATE OF withdrawn_at ON loopscope.annotation
  FOR EACH ROW EXECUTE FUNCTION loopscope.note_withdrawal();
