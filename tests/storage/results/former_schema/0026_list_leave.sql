-- Whoever is more likely sound than faulty leaves the list, however sure the other faults on it are.
INSERT INTO loopscope.parameter (name, value, unit, description) VALUES
  ('list_leave_probability', 0.5, 'probability, 0 to 1', 'fault_probability below which a loop leaves the list: behind many sure faults the mean of 1 - fault_probability alone would keep a loop that has been mended');

-- As in 0025 but for that probability.
CREATE OR REPLACE FUNCTION loopscope.list_questions(rate float8 DEFAULT NULL, dependence float8 DEFAULT NULL, least_confidence float8 DEFAULT NULL)
RETURNS TABLE (loop_id bigint, is_fault boolean, shown_code text, hidden boolean, fault_probability float8, probability_of_code float8, loop_p float8, threshold float8, bound float8,
               within_share boolean, rare boolean, enters boolean, flag_notice_id bigint, stays boolean) LANGUAGE sql STABLE
BEGIN ATOMIC
  WITH setting AS (
    SELECT coalesce(rate, max(value) FILTER (WHERE name = 'false_discovery_rate')) AS false_discovery_rate,
           max(value) FILTER (WHERE name = 'list_false_share') AS list_false_share,
           max(value) FILTER (WHERE name = 'list_leave_share') AS list_leave_share,
           max(value) FILTER (WHERE name = 'list_least_probability') AS list_least_probability,
           max(value) FILTER (WHERE name = 'list_leave_probability') AS list_leave_probability,
           max(value) FILTER (WHERE name = 'list_enough_windows') AS list_enough_windows,
           coalesce(dependence, max(value) FILTER (WHERE name = 'false_discovery_dependence')) AS false_discovery_dependence,
           coalesce(least_confidence, max(value) FILTER (WHERE name = 'min_confidence')) AS min_confidence
    FROM loopscope.parameter
  ), held AS (
    SELECT loop_id, array_agg(code) AS codes, bool_or(code IS NULL AND last_slot IS NULL) AS whatever_the_code, max(last_slot) AS last_slot
    FROM loopscope.hiding GROUP BY loop_id
  ), stay AS (  -- a program of before may have noted a second one
    SELECT DISTINCT ON (loop_id) loop_id, flag_notice_id, code, slot_end FROM loopscope.flag_notice WHERE ended_at IS NULL ORDER BY loop_id, flagged_at, flag_notice_id
  ), asked AS MATERIALIZED (
    SELECT latest.loop_id, latest.code, kind.is_fault, latest.fault_probability, latest.p, latest.algorithm_revision, latest.window_end, latest.window_end - latest.window_start AS window_length,
           coalesce(latest.combined_confidence, latest.confidence) AS probability_of_code,
           -- A verdict that rests on a test belongs to the family even if its analysis shows none.
           -- A model that may claim something makes two: of the next effect, and of what is left.
           greatest(CASE WHEN latest.usable THEN num_nonnulls(latest.nonlinear_p, latest.oscillation_p, latest.harris_p) + CASE WHEN latest.model_excited THEN 2 ELSE 0 END
                         ELSE 0 END, num_nonnulls(latest.p)) AS tests,
           seen.code AS shown_code,
           coalesce(held.whatever_the_code OR seen.code = ANY (held.codes) OR latest.slot_end <= held.last_slot, false) AS hidden,
           stay.flag_notice_id
    FROM loopscope.latest_verdict AS latest JOIN loopscope.verdict_kind AS kind USING (code)
    LEFT JOIN held USING (loop_id) LEFT JOIN stay USING (loop_id)
    LEFT JOIN LATERAL loopscope.last_fault(stay.loop_id, stay.slot_end, latest.slot_end) AS last
      ON NOT kind.is_fault AND stay.flag_notice_id IS NOT NULL
    -- What the list says of it.
    CROSS JOIN LATERAL (SELECT CASE WHEN kind.is_fault THEN latest.code ELSE coalesce(last.code, stay.code, latest.code) END AS code) AS seen
    WHERE latest.enabled
  ), shown AS MATERIALIZED (
    SELECT asked.*, asked.is_fault AND asked.probability_of_code >= setting.min_confidence AND NOT asked.hidden AS shown,
           asked.flag_notice_id IS NOT NULL AND NOT asked.hidden AND asked.code <> 'not_controlling' AS may_stay,
           CASE WHEN asked.p IS NOT NULL THEN least(asked.p * asked.tests, 1) END AS loop_p
    FROM asked CROSS JOIN setting
  ), scale AS MATERIALIZED (  -- once, not for every loop
    SELECT m * CASE WHEN false_discovery_dependence > 0
                    THEN (SELECT sum(1 / i::double precision) FROM generate_series(1, m) AS i) ELSE 1 END AS scaled_m
    FROM (SELECT count(*) AS m FROM shown WHERE tests > 0) AS family CROSS JOIN setting
  ), ranked AS (SELECT loop_p, row_number() OVER (ORDER BY loop_p) AS i FROM shown WHERE shown AND loop_p IS NOT NULL
  ), control AS (
    SELECT max(ranked.loop_p) AS threshold, max(ranked.i) AS passing FROM ranked CROSS JOIN scale CROSS JOIN setting
    WHERE ranked.loop_p <= setting.false_discovery_rate * ranked.i / nullif(scale.scaled_m, 0)
  ), listed AS (  -- those of one probability come together or not at all; sure faults lend a doubtful loop no place
    SELECT loop_id, doubt <= setting.list_false_share AND fault_probability >= setting.list_least_probability AS within_share
    FROM (SELECT loop_id, fault_probability, avg(1 - fault_probability) OVER (ORDER BY fault_probability DESC) AS doubt
          FROM shown WHERE shown AND fault_probability IS NOT NULL) AS ordered CROSS JOIN setting
  ), kept AS (
    SELECT loop_id, doubt <= setting.list_leave_share AND fault_probability >= greatest(setting.min_confidence, setting.list_leave_probability) AS within_leave_share
    FROM (SELECT loop_id, fault_probability, avg(1 - fault_probability) OVER (ORDER BY fault_probability DESC) AS doubt
          FROM shown WHERE (shown OR may_stay) AND fault_probability IS NOT NULL) AS ordered CROSS JOIN setting
  ), answered AS (
    SELECT shown.*, control.threshold,
           setting.false_discovery_rate * (coalesce(control.passing, 0) + 1) / nullif(scale.scaled_m, 0) AS bound, coalesce(listed.within_share, true) AS within_share,
           shown.p IS NULL OR shown.loop_p <= control.threshold OR setting.false_discovery_rate >= 1
             OR (shown.shown AND shown.fault_probability IS NOT NULL AND EXISTS (  -- another one that shares no sample and is not forgotten yet
                   SELECT FROM loopscope.analysis AS earlier
                   WHERE earlier.loop_id = shown.loop_id AND earlier.algorithm_revision = shown.algorithm_revision AND earlier.combined_windows IS NOT NULL
                     AND earlier.slot_end > shown.window_end - 7.5 * shown.window_length AND earlier.window_end > shown.window_end - 7.5 * shown.window_length
                     AND earlier.window_end <= shown.window_end - (setting.list_enough_windows - 1) * shown.window_length)) AS rare,
           -- A window that could not be judged says nothing: whoever is on the list stays.
           may_stay AND CASE WHEN shown.fault_probability IS NULL THEN shown.shown OR shown.code = 'insufficient_data' ELSE kept.within_leave_share END AS stays
    FROM shown LEFT JOIN listed USING (loop_id) LEFT JOIN kept USING (loop_id) CROSS JOIN control CROSS JOIN scale CROSS JOIN setting
  )
  SELECT loop_id, is_fault, shown_code, hidden, fault_probability, probability_of_code, loop_p, threshold, bound, within_share, coalesce(rare, false),
         shown AND within_share AND coalesce(rare, false), flag_notice_id, coalesce(stays, false)
  FROM answered;
END;

-- As in 0025, but the newest verdict is told as the cause only where it is probable enough, and it is said when the list is full.
CREATE OR REPLACE VIEW loopscope.hidden_loop AS
  WITH question AS MATERIALIZED (SELECT * FROM loopscope.list_questions()),
  likeliest AS (  -- of the causes behind healthy, whatever the verdict
    SELECT latest.loop_id, cause.name, cause.probability
    FROM loopscope.latest_verdict AS latest CROSS JOIN loopscope.parameter AS least
    CROSS JOIN LATERAL (
      SELECT weighed.name, weighed.probability::double precision
      FROM unnest('{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,nonlinear_unexplained}'::text[],
                  coalesce(latest.combined_probabilities, latest.cause_probabilities)) AS weighed (name, probability)
      WHERE weighed.name <> 'healthy' AND weighed.probability IS NOT NULL
      ORDER BY weighed.name = latest.code AND weighed.probability >= least.value DESC, weighed.probability DESC LIMIT 1) AS cause
    WHERE least.name = 'min_confidence'
    UNION ALL
    SELECT latest.loop_id, latest.code, latest.confidence FROM loopscope.latest_verdict AS latest
    WHERE coalesce(latest.combined_probabilities, latest.cause_probabilities) IS NULL
  ), held AS (
    SELECT latest.loop_id, hiding.hidden_by, hiding.until, hiding.reason, hiding.author, hiding.entered_at, hiding.annotation_id,
           hiding.plant_oscillation_number, hiding.source_loop_name
    FROM loopscope.hiding
    JOIN loopscope.latest_verdict AS latest USING (loop_id)
    JOIN question USING (loop_id)
    JOIN loopscope.verdict_kind AS kind ON kind.code = question.shown_code
    WHERE kind.is_fault AND (hiding.code IS NULL OR hiding.code = question.shown_code) AND (hiding.last_slot IS NULL OR latest.slot_end <= hiding.last_slot)
  ), unlisted AS (
    SELECT question.loop_id,
           CASE WHEN is_common THEN 'chance' ELSE 'probability' END AS hidden_by,
           CASE WHEN NOT is_common THEN 'not sure enough for the list (probability ' || round(coalesce(question.fault_probability, likeliest.probability)::numeric, 2) || ')'
                     || CASE WHEN question.fault_probability >= list_least.value
                             THEN ': with the surer ones, more than ' || round((100 * list_false.value)::numeric, 1)::float8 || ' % of the list would be no fault' ELSE '' END
                WHEN question.loop_p >= 1 THEN 'no test of this window shows it: its probability alone decides once more windows have been read'
                ELSE 'as strong evidence is found by chance too often among so many loops (p ' || trim(to_char(question.loop_p, '9.9EEEE'))
                     || coalesce(', at most ' || trim(to_char(question.bound, '9.9EEEE')) || ' would do', '')
                     || '): its probability alone decides once more windows have been read' END AS reason
    FROM question JOIN likeliest USING (loop_id)
    JOIN loopscope.parameter AS list_least ON list_least.name = 'list_least_probability'
    JOIN loopscope.parameter AS list_false ON list_false.name = 'list_false_share'
    CROSS JOIN LATERAL (SELECT NOT question.rare AND question.is_fault AND question.within_share AND coalesce(question.fault_probability, 1) >= list_least.value AS is_common) AS by_chance
    JOIN loopscope.parameter AS least ON least.name = 'min_confidence'
    WHERE NOT question.enters AND NOT question.stays AND likeliest.probability >= least.value AND likeliest.name NOT IN ('healthy', 'not_controlling', 'insufficient_data')
      AND question.loop_id NOT IN (SELECT loop_id FROM held)
  ), hidden AS (
    SELECT * FROM held
    UNION ALL
    SELECT loop_id, hidden_by, NULL, reason, NULL, NULL, NULL, NULL, NULL FROM unlisted
  )
  SELECT latest.loop_id, latest.loop_name, latest.code, latest.confidence, latest.slot_end, latest.summary,
         hidden.hidden_by, hidden.until, hidden.reason, hidden.author, hidden.entered_at, hidden.annotation_id,
         hidden.plant_oscillation_number, hidden.source_loop_name,
         likeliest.name AS cause, likeliest.probability, latest.area, latest.unit, latest.description, latest.owner
  FROM hidden
  JOIN loopscope.latest_verdict AS latest USING (loop_id)
  LEFT JOIN likeliest USING (loop_id)
  WHERE latest.enabled;

COMMENT ON VIEW loopscope.flagged_loop IS 'Loops that somebody should act on, dead measurements first, then by score. A fault of an enabled loop enters while the expected share of loops without a fault on the list is below list_false_share and it is probable (list_least_probability), if it is a fact, passes the false-discovery control or stands behind list_enough_windows windows; it stays until that share exceeds list_leave_share or a fault is less probable than list_leave_probability, and is gone at once when annotated away or found to be the victim of a shared oscillation';
