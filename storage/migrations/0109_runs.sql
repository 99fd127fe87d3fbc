-- Since when a fault is there. One window in between that says otherwise is wrong more often than that the fault went
-- and came back, and one repair's faults are taken for each other from window to window: what ends a run is what
-- confirms one, a second window that shares no sample and says the same. storage/MEASURED.md has the figures.
CREATE OR REPLACE FUNCTION loopscope.verdict_run(of_loop bigint, newest_slot timestamptz, of_code text)
RETURNS TABLE (since timestamptz, confirmed boolean) LANGUAGE sql STABLE
BEGIN ATOMIC
  -- The key's index, which holds the code, is read back up to the gap that ends the run; only of windows that say
  -- otherwise anything more is asked.
  WITH own AS (
    SELECT coalesce((SELECT family FROM loopscope.fault_family WHERE code = of_code), of_code) AS family
  ), wording AS (
    SELECT array_agg(kind.code) FILTER (WHERE coalesce(family.family, kind.code) = own.family) AS agreeing,
           -- What cannot be judged says nothing, and neither does a fault without a name of any that has one.
           array_agg(kind.code) FILTER (
             WHERE coalesce(family.family, kind.code) <> own.family
               AND kind.code NOT IN ('insufficient_data', 'not_controlling')
               AND NOT (kind.is_fault AND of_code IN (SELECT code FROM loopscope.fault_family)
                        AND 'unknown' IN (family.family, own.family))) AS contrary
    FROM own CROSS JOIN loopscope.verdict_kind AS kind LEFT JOIN loopscope.fault_family AS family USING (code)
    GROUP BY own.family
  ), said AS NOT MATERIALIZED (  -- by the newest revision of each slot; with OFFSET 0 it is asked row by row
    SELECT given.slot_end, given.code FROM loopscope.verdict AS given
    WHERE given.loop_id = of_loop AND given.slot_end <= newest_slot
      AND NOT EXISTS (
        SELECT FROM loopscope.verdict AS newer
        WHERE newer.loop_id = of_loop AND newer.slot_end = given.slot_end
          AND (newer.algorithm_revision, newer.input_revision) > (given.algorithm_revision, given.input_revision)
        OFFSET 0)
  ), contrary AS (
    SELECT slot_end, lag(slot_end) OVER (ORDER BY slot_end DESC) AS later
    FROM (SELECT DISTINCT slot_end FROM loopscope.verdict
          WHERE loop_id = of_loop AND slot_end <= newest_slot AND code = ANY ((SELECT contrary FROM wording)::text[])
          ORDER BY slot_end DESC OFFSET 0) AS any_revision
    WHERE EXISTS (SELECT FROM said
                  WHERE said.slot_end = any_revision.slot_end
                    AND said.code = ANY ((SELECT contrary FROM wording)::text[]) OFFSET 0)
  ), gap AS (  -- of windows that say otherwise, one after the other
    SELECT slot_end, min(CASE WHEN starts THEN slot_end END) OVER (ORDER BY slot_end DESC) AS last_slot
    FROM (SELECT slot_end,
                 later IS NULL OR EXISTS (
                   SELECT FROM said
                   WHERE said.slot_end > contrary.slot_end AND said.slot_end < contrary.later
                     AND said.code = ANY ((SELECT agreeing FROM wording)::text[])
                   OFFSET 0) AS starts
          FROM contrary) AS cut
  ), ended AS (  -- by the newest gap of two windows that share no sample
    SELECT slot_end FROM gap
    WHERE last_slot > slot_end
      -- window_end is the last sample of a window, window_start the first.
      AND (SELECT later.window_start FROM loopscope.analysis AS later
           WHERE later.loop_id = of_loop AND later.slot_end = gap.last_slot
           ORDER BY later.algorithm_revision DESC LIMIT 1)
          > (SELECT earlier.window_end FROM loopscope.analysis AS earlier
             WHERE earlier.loop_id = of_loop AND earlier.slot_end = gap.slot_end
             ORDER BY earlier.algorithm_revision DESC LIMIT 1)
    ORDER BY slot_end DESC LIMIT 1
  ), first AS (
    SELECT slot_end
    FROM (SELECT DISTINCT slot_end FROM loopscope.verdict
          WHERE loop_id = of_loop AND slot_end <= newest_slot AND code = ANY ((SELECT agreeing FROM wording)::text[])
            AND slot_end > coalesce((SELECT slot_end FROM ended), '-infinity')
          ORDER BY slot_end OFFSET 0) AS any_revision
    WHERE EXISTS (SELECT FROM said
                  WHERE said.slot_end = any_revision.slot_end
                    AND said.code = ANY ((SELECT agreeing FROM wording)::text[]) OFFSET 0)
    ORDER BY slot_end LIMIT 1
  )
  SELECT first.slot_end,
         coalesce((SELECT newest.window_start FROM loopscope.analysis AS newest
                   WHERE newest.loop_id = of_loop AND newest.slot_end = newest_slot
                   ORDER BY newest.algorithm_revision DESC LIMIT 1)
                  > (SELECT oldest.window_end FROM loopscope.analysis AS oldest
                     WHERE oldest.loop_id = of_loop AND oldest.slot_end = first.slot_end
                     ORDER BY oldest.algorithm_revision DESC LIMIT 1), false)
  FROM first;
END;
COMMENT ON FUNCTION loopscope.verdict_run(bigint, timestamp with time zone, text) IS
  'Of the verdict of_code that the loop has at newest_slot: the slot since which verdicts of its family were given, '
  'without two windows in between that share no sample and say otherwise one after the other; and whether it is '
  'confirmed by a window that shares no sample with the first one of the run';

COMMENT ON COLUMN loopscope.flagged_loop.status IS
  'watch = new; confirmed = a verdict of the same family (fault_family) came in a second window that shares no sample '
  'with the first one of its run';
COMMENT ON COLUMN loopscope.flagged_loop.since IS
  'Slot of the first verdict of the run of this family (fault_family), which two windows that share no sample and say '
  'otherwise, one after the other, end, or of the stay on the list, the earlier one. Where the loop has no judged '
  'window before it, the fault may be older';

-- A stay that lasts began when the list says: windows that were judged later, of times before, count. DISTINCT lets the
-- planner leave the list out where nobody asks since when.
CREATE OR REPLACE VIEW loopscope.flag_history AS
  SELECT notice.flag_notice_id, notice.loop_id, loop.name AS loop_name, notice.code, notice.flagged_at,
         least(standing.since, notice.since) AS since, notice.status, notice.confirmed_at, notice.ended_at,
         notice.ended_by, notice.ended_at IS NULL AS stands, notice.announced, notice.slot_end, notice.confidence,
         notice.rank, notice.score, notice.summary
  FROM loopscope.flag_notice AS notice JOIN loopscope.loop USING (loop_id)
  LEFT JOIN (SELECT DISTINCT ON (loop_id) loop_id, since FROM loopscope.flagged_loop) AS standing
    ON standing.loop_id = notice.loop_id AND notice.ended_at IS NULL;
COMMENT ON COLUMN loopscope.flag_history.since IS
  'Slot of the first verdict of its run; of a stay that lasts as in flagged_loop, else as it was known when it came';

UPDATE loopscope.data_problem_kind SET
  words = 'Most rows of the window are of bad quality, or have no value',
  remedy = 'Check transmitter, wiring and interface; where the historian keeps the value of such a tag in another '
           'column, name that in the settings (more_value_columns)'
WHERE code = 'bad_quality';

-- Where a fault is probable and yet not on the list, the reason is that the list is full, not that it is not sure.
CREATE OR REPLACE VIEW loopscope.hidden_loop AS
  WITH question AS MATERIALIZED (SELECT * FROM loopscope.list_questions()),
  likeliest AS (  -- of the causes behind healthy, whatever the verdict
    SELECT latest.loop_id, cause.name, cause.probability
    FROM loopscope.own_verdict AS latest CROSS JOIN loopscope.parameter AS least
    CROSS JOIN LATERAL (
      SELECT weighed.name, weighed.probability::double precision
      FROM unnest('{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,'
                  'process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,'
                  'nonlinear_unexplained}'::text[],
                  coalesce(latest.combined_probabilities, latest.cause_probabilities)) AS weighed (name, probability)
      WHERE weighed.name <> 'healthy' AND weighed.probability IS NOT NULL
      ORDER BY weighed.name = latest.code AND weighed.probability >= least.value DESC, weighed.probability DESC
      LIMIT 1) AS cause
    WHERE least.name = 'min_confidence'
    UNION ALL
    SELECT latest.loop_id, latest.code, latest.confidence FROM loopscope.own_verdict AS latest
    WHERE coalesce(latest.combined_probabilities, latest.cause_probabilities) IS NULL
  ), held AS (
    SELECT latest.loop_id, hiding.hidden_by, hiding.until, hiding.reason, hiding.author, hiding.entered_at,
           hiding.annotation_id, hiding.plant_oscillation_number, hiding.source_loop_name, hiding.on_behalf_of
    FROM loopscope.hiding
    JOIN loopscope.own_verdict AS latest USING (loop_id)
    JOIN question USING (loop_id)
    JOIN loopscope.verdict_kind AS kind ON kind.code = question.shown_code
    WHERE kind.is_fault AND (hiding.code IS NULL OR hiding.code = question.shown_code)
      AND (hiding.last_slot IS NULL OR latest.slot_end <= hiding.last_slot)
  ), unlisted AS (
    SELECT question.loop_id,
           CASE WHEN is_common THEN 'chance' ELSE 'probability' END AS hidden_by,
           CASE WHEN NOT is_common
                THEN CASE WHEN question.fault_probability >= list_least.value
                          THEN 'a fault is probable (' || round(question.fault_probability::numeric, 2)
                               || '), but the surer ones fill the list: with this loop more than '
                               || round((100 * list_false.value)::numeric, 1)::float8
                               || ' % of the loops on it would be expected to have no fault'
                          ELSE 'not sure enough for the list (probability '
                               || round(coalesce(question.fault_probability, likeliest.probability)::numeric, 2)
                               || ')' END
                WHEN question.loop_p >= 1
                THEN 'no test of this window shows it: its probability alone decides once more windows have been read'
                ELSE 'as strong evidence is found by chance too often among so many loops (p '
                     || trim(to_char(question.loop_p, '9.9EEEE'))
                     || coalesce(', at most ' || trim(to_char(question.bound, '9.9EEEE')) || ' would do', '')
                     || '): its probability alone decides once more windows have been read' END AS reason
    FROM question JOIN likeliest USING (loop_id)
    JOIN loopscope.parameter AS list_least ON list_least.name = 'list_least_probability'
    JOIN loopscope.parameter AS list_false ON list_false.name = 'list_false_share'
    CROSS JOIN LATERAL (
      SELECT NOT question.rare AND question.is_fault AND question.within_share
             AND coalesce(question.fault_probability, 1) >= list_least.value AS is_common) AS by_chance
    JOIN loopscope.parameter AS least ON least.name = 'min_confidence'
    WHERE NOT question.enters AND NOT question.stays AND likeliest.probability >= least.value
      AND likeliest.name NOT IN ('healthy', 'not_controlling', 'insufficient_data')
      AND question.loop_id NOT IN (SELECT loop_id FROM held)
  ), hidden AS (
    SELECT * FROM held
    UNION ALL
    SELECT loop_id, hidden_by, NULL, reason, NULL, NULL, NULL, NULL, NULL, NULL FROM unlisted
  )
  SELECT latest.loop_id, latest.loop_name, latest.code, latest.confidence, latest.slot_end, latest.summary,
         hidden.hidden_by, hidden.until, hidden.reason, hidden.author, hidden.entered_at, hidden.annotation_id,
         hidden.plant_oscillation_number, hidden.source_loop_name,
         likeliest.name AS cause, likeliest.probability, latest.area, latest.unit, latest.description, latest.owner,
         hidden.on_behalf_of
  FROM hidden
  JOIN loopscope.own_verdict AS latest USING (loop_id)
  LEFT JOIN likeliest USING (loop_id)
  WHERE latest.enabled;
