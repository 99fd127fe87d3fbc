-- What is found across loops, and what people tell the monitor.

CREATE TABLE loopscope.plant_oscillation (
  slot_end           timestamptz NOT NULL,
  algorithm_revision integer NOT NULL,
  number             integer NOT NULL CHECK (number > 0),
  period_s           double precision NOT NULL CHECK (period_s > 0),
  loop_ids           bigint[] NOT NULL CHECK (cardinality(loop_ids) >= 2),
  strengths          double precision[] NOT NULL,
  lags_s             double precision[] NOT NULL,
  source_loop_id     bigint REFERENCES loopscope.loop ON DELETE SET NULL,
  statement          text NOT NULL,
  found_at           timestamptz NOT NULL DEFAULT now(),
  PRIMARY KEY (slot_end, algorithm_revision, number),
  CONSTRAINT plant_oscillation_members CHECK (
    cardinality(strengths) = cardinality(loop_ids) AND cardinality(lags_s) = cardinality(loop_ids))
);
COMMENT ON TABLE loopscope.plant_oscillation IS 'Oscillations that several loops share, with their likely source';
COMMENT ON COLUMN loopscope.plant_oscillation.slot_end IS 'End of the slot that was compared across loops';
COMMENT ON COLUMN loopscope.plant_oscillation.algorithm_revision IS 'Raised whenever the program may judge the same data differently';
COMMENT ON COLUMN loopscope.plant_oscillation.number IS '1 = the oscillation with the most loops';
COMMENT ON COLUMN loopscope.plant_oscillation.period_s IS 'Shared period, seconds';
COMMENT ON COLUMN loopscope.plant_oscillation.loop_ids IS 'Numbers of the loops that share it';
COMMENT ON COLUMN loopscope.plant_oscillation.strengths IS 'Share of each loop''s error variance at that period, 0 to 1, in the order of loop_ids';
COMMENT ON COLUMN loopscope.plant_oscillation.lags_s IS 'How much later than the source each loop swings, seconds, in the order of loop_ids';
COMMENT ON COLUMN loopscope.plant_oscillation.source_loop_id IS 'Loop that most likely causes it; null = outside or unknown';
COMMENT ON COLUMN loopscope.plant_oscillation.statement IS 'Why that loop, in words';
COMMENT ON COLUMN loopscope.plant_oscillation.found_at IS 'When the row was written';

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
COMMENT ON TABLE loopscope.maintenance_event IS 'What people did to a loop; before_after_maintenance compares the analyses around it';
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
  CONSTRAINT annotation_suppression_ends CHECK (
    kind <> 'suppressed' OR (until IS NOT NULL AND isfinite(until) AND reason <> '' AND reason IS NOT NULL))
);
CREATE INDEX annotation_of_loop ON loopscope.annotation (loop_id);
COMMENT ON TABLE loopscope.annotation IS 'What people said about a loop''s verdict; while one holds, the loop is not in flagged_loop';
COMMENT ON COLUMN loopscope.annotation.annotation_id IS 'Number of the annotation';
COMMENT ON COLUMN loopscope.annotation.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.annotation.kind IS 'acknowledged (known, work is planned), suppressed (until a time, for a reason) or false_positive (the verdict is wrong)';
COMMENT ON COLUMN loopscope.annotation.code IS 'Verdict that it is about; null = whatever the verdict';
COMMENT ON COLUMN loopscope.annotation.until IS 'When it ends to hold; null = when it is withdrawn';
COMMENT ON COLUMN loopscope.annotation.reason IS 'Why; required to suppress';
COMMENT ON COLUMN loopscope.annotation.author IS 'Who entered it';
COMMENT ON COLUMN loopscope.annotation.entered_at IS 'When it was entered';
COMMENT ON COLUMN loopscope.annotation.withdrawn_at IS 'When it was taken back; null = it holds';
