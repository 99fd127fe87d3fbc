-- Clocks that were wrong: what lies after now() never wins, and a row that somebody has spoilt stops nobody but its loop.

-- For how long a claim was made, so that one whose clock was ahead can be told from one that holds.
ALTER TABLE loopscope.schedule ADD COLUMN hold_s double precision CHECK (hold_s > 0 AND hold_s < 'infinity');
COMMENT ON COLUMN loopscope.schedule.hold_s IS 'Seconds for which the last claim was made or prolonged; null = none yet, or by a program that does not note it';

-- A value that a claim cannot add to, or read, would stop every batch that it is in. What stands there already is mended.
UPDATE loopscope.schedule SET
  fence = least(greatest(fence, 0), (2 ^ 62)::bigint - 1),
  attempts = least(greatest(attempts, 0), 1000000), lost_leases = least(greatest(lost_leases, 0), 1000000),
  last_slot_end = CASE WHEN isfinite(last_slot_end) AND last_slot_end < '294000-01-01+00' THEN last_slot_end END,
  result_slot_end = CASE WHEN isfinite(result_slot_end) AND result_slot_end < '294000-01-01+00' THEN result_slot_end END
WHERE fence NOT BETWEEN 0 AND (2 ^ 62)::bigint - 1 OR attempts NOT BETWEEN 0 AND 1000000 OR lost_leases NOT BETWEEN 0 AND 1000000
   OR NOT (isfinite(last_slot_end) AND last_slot_end < '294000-01-01+00')
   OR NOT (isfinite(result_slot_end) AND result_slot_end < '294000-01-01+00');
ALTER TABLE loopscope.schedule
  ADD CONSTRAINT schedule_fence CHECK (fence >= 0),
  ADD CONSTRAINT schedule_attempts CHECK (attempts BETWEEN 0 AND 1000000),
  ADD CONSTRAINT schedule_lost_leases CHECK (lost_leases BETWEEN 0 AND 1000000),
  -- Microseconds of later years are beyond a bigint.
  ADD CONSTRAINT schedule_last_slot_end CHECK (isfinite(last_slot_end) AND last_slot_end < '294000-01-01+00'),
  ADD CONSTRAINT schedule_result_slot_end CHECK (isfinite(result_slot_end) AND result_slot_end < '294000-01-01+00');

-- From one claim to the next the fence rises by one: it can be neither turned back nor brought to its end.
CREATE FUNCTION loopscope.refuse_fence() RETURNS trigger LANGUAGE plpgsql SET search_path = pg_catalog AS $$
BEGIN
  RAISE EXCEPTION 'schedule.fence of loop % rises by one with each claim, not from % to %', OLD.loop_id, OLD.fence, NEW.fence
    USING ERRCODE = 'check_violation';
END $$;
COMMENT ON FUNCTION loopscope.refuse_fence() IS 'Refuses a fence that does not rise by one';
CREATE TRIGGER fence_rises BEFORE UPDATE OF fence ON loopscope.schedule FOR EACH ROW
  WHEN (NEW.fence < OLD.fence OR NEW.fence > OLD.fence + 1) EXECUTE FUNCTION loopscope.refuse_fence();

-- What a person has said of clocks that differ (loopscope maintain --accept-clock).
CREATE TABLE loopscope.accepted_clock (
  clock       text PRIMARY KEY CHECK (clock <> ''),
  ahead_s     double precision NOT NULL CHECK (abs(ahead_s) < 'infinity'),
  accepted_at timestamptz NOT NULL DEFAULT now(),
  accepted_by text NOT NULL DEFAULT session_user
);
COMMENT ON TABLE loopscope.accepted_clock IS 'Clocks that differ from the one of this server, which a person has called the right one; one row each';
COMMENT ON COLUMN loopscope.accepted_clock.clock IS '"host NAME" of a worker or "historian NAME" of the settings';
COMMENT ON COLUMN loopscope.accepted_clock.ahead_s IS 'Seconds by which it was ahead of this server then, negative = behind; a difference that has changed since is not accepted';
COMMENT ON COLUMN loopscope.accepted_clock.accepted_at IS 'When it was said, by the clock of this server';
COMMENT ON COLUMN loopscope.accepted_clock.accepted_by IS 'Login of whoever said it';

-- A round that was stored under a clock ahead holds when its time has come.
CREATE OR REPLACE VIEW loopscope.newest_plant_round AS
  SELECT round.*, round.slot_end + parameter.value * interval '1 day' AS holds_until
  FROM (SELECT * FROM loopscope.plant_round WHERE slot_end <= now() ORDER BY slot_end DESC, algorithm_revision DESC LIMIT 1) AS round
  JOIN loopscope.parameter ON parameter.name = 'plant_round_valid_days';

-- Results have a time of their own: their newest slot. Nothing is expired by a clock that has run on without them.
CREATE FUNCTION loopscope.newest_result() RETURNS timestamptz LANGUAGE sql STABLE SET search_path = pg_catalog AS $$
  SELECT max(slot_end) FROM loopscope.analysis WHERE slot_end <= now()
$$;
COMMENT ON FUNCTION loopscope.newest_result() IS 'Newest slot with a stored analysis that is not after now(); null = none';

ALTER FUNCTION loopscope.grant_rights() RENAME TO grant_rights_of_0016;
CREATE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
BEGIN
  PERFORM loopscope.grant_rights_of_0016();
  IF to_regrole('loopscope_worker') IS NOT NULL THEN
    GRANT UPDATE (hold_s) ON loopscope.schedule TO loopscope_worker;
  END IF;
END $$;
COMMENT ON FUNCTION loopscope.grant_rights_of_0016() IS 'The part of grant_rights() that stood before claims noted for how long they hold';
COMMENT ON FUNCTION loopscope.grant_rights() IS 'Gives loopscope_worker, loopscope_reader and loopscope_engineer, where they exist, exactly the rights that they need, and takes every other one back';
