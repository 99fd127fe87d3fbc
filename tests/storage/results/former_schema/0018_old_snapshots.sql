-- Claims under an old snapshot (a dump, an open transaction of a reader): every version of a row that an update has left behind
-- stays until the snapshot ends, and so does its entry in each index. What a claim or a completion looks up must not lie behind them.

-- By the loop alone, one loop's versions all have the same key: the look for a duplicate at each update passes all of them. With the
-- fence, which rises with each claim, a key has two or three. That a loop has one row is the work of triggers then.
ALTER TABLE loopscope.schedule DROP CONSTRAINT schedule_pkey;
ALTER TABLE loopscope.schedule ADD PRIMARY KEY (loop_id, fence);

-- Loops of one period are due in the same instant: with loop_id behind it, a scan can begin between them.
DROP INDEX loopscope.schedule_due;
CREATE INDEX schedule_due ON loopscope.schedule (visible_at, loop_id) WHERE enabled;
-- What is looked for at every poll and is rare has an index of its own, small and with nothing dead at its head.
CREATE INDEX schedule_suspect ON loopscope.schedule (visible_at) WHERE enabled AND lost_leases >= 2;
CREATE INDEX schedule_held ON loopscope.schedule (visible_at) WHERE enabled AND owner IS NOT NULL;
CREATE INDEX schedule_failing ON loopscope.schedule (loop_id) WHERE enabled AND attempts > 0;
CREATE INDEX schedule_ahead ON loopscope.schedule (loop_id) WHERE enabled AND (last_slot_end > visible_at OR result_slot_end > visible_at);
CREATE INDEX loop_period ON loopscope.loop (period_s) WHERE enabled;

-- Every update changes an indexed column, so that none stays within its page: room left on the page is never used.
ALTER TABLE loopscope.schedule RESET (fillfactor);

-- A loop that is enabled again is due now, not when it last was: nobody looks that far back.
CREATE OR REPLACE FUNCTION loopscope.follow_loop() RETURNS trigger LANGUAGE plpgsql
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

CREATE FUNCTION loopscope.refuse_second_schedule() RETURNS trigger LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
DECLARE doubled bigint;
BEGIN
  SELECT min(added.loop_id) INTO doubled FROM added JOIN loopscope.schedule AS kept USING (loop_id) WHERE kept.fence <> added.fence;
  IF doubled IS NOT NULL THEN
    RAISE EXCEPTION 'loop % has its row in loopscope.schedule already', doubled USING ERRCODE = 'unique_violation';
  END IF;
  RETURN NULL;
END $$;
COMMENT ON FUNCTION loopscope.refuse_second_schedule() IS 'Refuses a second row of one loop in loopscope.schedule';
CREATE TRIGGER one_row AFTER INSERT ON loopscope.schedule
  REFERENCING NEW TABLE AS added FOR EACH STATEMENT EXECUTE FUNCTION loopscope.refuse_second_schedule();

-- A claim that was made for ages ends in its time as well; beyond what an interval holds the sum would stop the look for all.
UPDATE loopscope.schedule SET hold_s = NULL WHERE hold_s > 1000000;
ALTER TABLE loopscope.schedule ADD CONSTRAINT schedule_hold_s CHECK (hold_s <= 1000000);

-- The same holds of the figures that the views compute with, which a worker may set.
UPDATE loopscope.parameter SET value = least(greatest(value, -1000000), 1000000) WHERE NOT abs(value) <= 1000000;
ALTER TABLE loopscope.parameter ADD CONSTRAINT parameter_value CHECK (abs(value) <= 1000000);
