-- hidden_loop in half the time: own_verdict is read once, and the likeliest cause is looked for of the loops alone that
-- can be in the view. Its rows are those of before.

CREATE OR REPLACE VIEW loopscope.hidden_loop AS
  WITH question AS MATERIALIZED (SELECT * FROM loopscope.list_questions()),
  latest AS MATERIALIZED (
    SELECT loop_id, loop_name, code, confidence, slot_end, summary, enabled, area, unit, description, owner,
           coalesce(combined_probabilities, cause_probabilities) AS probabilities
    FROM loopscope.own_verdict
  ), held AS (
    SELECT latest.loop_id, hiding.hidden_by, hiding.until, hiding.reason, hiding.author, hiding.entered_at,
           hiding.annotation_id, hiding.plant_oscillation_number, hiding.source_loop_name, hiding.on_behalf_of
    FROM loopscope.hiding
    JOIN latest USING (loop_id)
    JOIN question USING (loop_id)
    JOIN loopscope.verdict_kind AS kind ON kind.code = question.shown_code
    WHERE kind.is_fault AND (hiding.code IS NULL OR hiding.code = question.shown_code)
      AND (hiding.last_slot IS NULL OR latest.slot_end <= hiding.last_slot)
  ), asked AS (  -- a cause is at most as probable as any fault, but for the rounding of real: others need no look
    SELECT latest.loop_id, latest.code, latest.confidence, latest.probabilities, least.value AS least
    FROM latest JOIN question USING (loop_id) JOIN loopscope.parameter AS least ON least.name = 'min_confidence'
    WHERE question.loop_id IN (SELECT loop_id FROM held)
       OR NOT question.enters AND NOT question.stays
          AND coalesce(latest.probabilities[1], 0) <= 1 - least.value + 0.001
  ), likeliest AS (  -- of the causes behind healthy, whatever the verdict
    SELECT asked.loop_id, cause.name, cause.probability
    FROM asked
    CROSS JOIN LATERAL (
      SELECT weighed.name, weighed.probability::double precision
      FROM unnest('{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,'
                  'process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,'
                  'nonlinear_unexplained}'::text[], asked.probabilities) AS weighed (name, probability)
      WHERE weighed.name <> 'healthy' AND weighed.probability IS NOT NULL
      ORDER BY weighed.name = asked.code AND weighed.probability >= asked.least DESC, weighed.probability DESC
      LIMIT 1) AS cause
    UNION ALL
    SELECT asked.loop_id, asked.code, asked.confidence FROM asked WHERE asked.probabilities IS NULL
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
  JOIN latest USING (loop_id)
  LEFT JOIN likeliest USING (loop_id)
  WHERE latest.enabled;
