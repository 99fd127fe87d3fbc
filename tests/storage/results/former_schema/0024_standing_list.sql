-- A list that stands still: a loop enters at one rate and leaves at a second, looser one; its stays are rows of flag_notice, so that
-- the list follows from what is stored. What is probable and not on the list can be found.

INSERT INTO loopscope.parameter (name, value, unit, description) VALUES
  ('list_enough_windows', 2, 'windows, > 0', 'From so many windows on that share no sample the odds of all of them decide whether a loop enters the list; before, evidence as strong has to be rare as well'),
  ('list_leave_share', 0.2, 'share, 0 to 1', 'A loop that is on the list stays until the mean of 1 - fault_probability over those that are as probable or more exceeds this, or its fault_probability falls below min_confidence');
ALTER TABLE loopscope.flag_notice DROP CONSTRAINT flag_notice_ended_by_check,
  ADD CONSTRAINT flag_notice_ended_by_check CHECK (ended_by IN ('verdict', 'annotation', 'plant', 'disabled', 'threshold', 'state'));
COMMENT ON COLUMN loopscope.flag_notice.ended_by IS 'What ended it: verdict (healthy again), annotation, plant (found to be a victim), disabled, state (no controller acts), or threshold (no longer probable enough)';
COMMENT ON COLUMN loopscope.flag_notice.code IS 'Verdict that it was flagged with; while the loop stays its verdict may become another one';

-- Of a stay whose newest window names no fault the last one that did, by the newest revision of each slot.
CREATE FUNCTION loopscope.last_fault(of_loop bigint, from_slot timestamptz, to_slot timestamptz)
RETURNS TABLE (slot_end timestamptz, algorithm_revision integer, input_revision integer, code text) LANGUAGE sql STABLE
BEGIN ATOMIC
  SELECT given.slot_end, given.algorithm_revision, given.input_revision, given.code FROM loopscope.verdict AS given
  WHERE given.loop_id = of_loop AND given.slot_end BETWEEN from_slot AND to_slot AND given.code NOT IN ('healthy', 'not_controlling', 'insufficient_data')
    AND NOT EXISTS (
      SELECT FROM loopscope.verdict AS newer
      WHERE newer.loop_id = of_loop AND newer.slot_end = given.slot_end
        AND (newer.algorithm_revision, newer.input_revision) > (given.algorithm_revision, given.input_revision))
  ORDER BY given.slot_end DESC LIMIT 1;
END;
COMMENT ON FUNCTION loopscope.last_fault(bigint, timestamptz, timestamptz) IS 'The last slot of a span whose verdict, by its newest revision, names a fault';

-- One row per analysed, enabled loop: what the list asks of it. The family of the control is the loops: each asks the plant one
-- question, whether its fault is chance, with one p, that of its verdict times the tests that it may have been picked from
-- (core/plant/README.md). What hides a verdict hides it before both questions, and leaves the family as large as it was.
CREATE FUNCTION loopscope.list_questions(rate float8 DEFAULT NULL, dependence float8 DEFAULT NULL, least_confidence float8 DEFAULT NULL)
RETURNS TABLE (loop_id bigint, is_fault boolean, shown_code text, hidden boolean, fault_probability float8, probability_of_code float8, loop_p float8, threshold float8, bound float8,
               within_share boolean, rare boolean, enters boolean, flag_notice_id bigint, stays boolean) LANGUAGE sql STABLE
BEGIN ATOMIC
  WITH setting AS (
    SELECT coalesce(rate, max(value) FILTER (WHERE name = 'false_discovery_rate')) AS false_discovery_rate,
           max(value) FILTER (WHERE name = 'list_false_share') AS list_false_share,
           max(value) FILTER (WHERE name = 'list_leave_share') AS list_leave_share,
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
    SELECT latest.loop_id, latest.code, kind.is_fault, latest.fault_probability, latest.p, latest.windows_together,
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
  ), listed AS (  -- those of one probability come together or not at all; what is more likely no fault than one does not enter
    SELECT loop_id, doubt <= setting.list_false_share AND fault_probability >= 0.5 AS within_share
    FROM (SELECT loop_id, fault_probability, avg(1 - fault_probability) OVER (ORDER BY fault_probability DESC) AS doubt
          FROM shown WHERE shown AND fault_probability IS NOT NULL) AS ordered CROSS JOIN setting
  ), kept AS (
    SELECT loop_id, doubt <= setting.list_leave_share AND fault_probability >= setting.min_confidence AS within_leave_share
    FROM (SELECT loop_id, fault_probability, avg(1 - fault_probability) OVER (ORDER BY fault_probability DESC) AS doubt
          FROM shown WHERE (shown OR may_stay) AND fault_probability IS NOT NULL) AS ordered CROSS JOIN setting
  ), answered AS (
    SELECT shown.*, control.threshold,
           setting.false_discovery_rate * (coalesce(control.passing, 0) + 1) / nullif(scale.scaled_m, 0) AS bound, coalesce(listed.within_share, true) AS within_share,
           shown.p IS NULL OR shown.loop_p <= control.threshold OR setting.false_discovery_rate >= 1
             OR coalesce(shown.windows_together >= setting.list_enough_windows AND shown.fault_probability IS NOT NULL, false) AS rare,
           -- A window that could not be judged says nothing: whoever is on the list stays.
           may_stay AND CASE WHEN shown.fault_probability IS NULL THEN shown.shown OR shown.code = 'insufficient_data' ELSE kept.within_leave_share END AS stays
    FROM shown LEFT JOIN listed USING (loop_id) LEFT JOIN kept USING (loop_id) CROSS JOIN control CROSS JOIN scale CROSS JOIN setting
  )
  SELECT loop_id, is_fault, shown_code, hidden, fault_probability, probability_of_code, loop_p, threshold, bound, within_share, coalesce(rare, false),
         shown AND within_share AND coalesce(rare, false), flag_notice_id, coalesce(stays, false)
  FROM answered;
END;
COMMENT ON FUNCTION loopscope.list_questions(double precision, double precision, double precision) IS 'What the list asks of each analysed, enabled loop, and whether it enters or stays; shown_code = the verdict, or, of a stay whose newest window names no fault, the last that did; thresholds as in flagged_at(); threshold = the largest loop_p that passes the control, bound = what one more would have to be below';

-- Other thresholds than those that are set have no stays: what would be flagged is what would enter.
CREATE FUNCTION loopscope.list_at(rate float8 DEFAULT NULL, dependence float8 DEFAULT NULL, least_confidence float8 DEFAULT NULL)
RETURNS TABLE (
  rank bigint, loop_id bigint, loop_name text, source text, loop_type text, code text, score float8, severity float8,
  importance float8, kind_weight float8, confidence float8, p float8, false_discovery_threshold float8, nonlinear_p float8,
  slot_end timestamptz, algorithm_revision integer, input_revision integer, analysis_id bigint, summary text, reasons text[],
  action text, ngi float8, nli float8, oscillation_period_s float8, harris_low float8, harris_high float8,
  status text, since timestamptz, plant_oscillation_number integer,
  combined_confidence float8, fault_probability float8, area text, unit text, description text, owner text) LANGUAGE sql STABLE
BEGIN ATOMIC
  WITH question AS MATERIALIZED (
    SELECT * FROM loopscope.list_questions(rate, dependence, least_confidence)
    WHERE enters OR stays AND rate IS NULL AND dependence IS NULL AND least_confidence IS NULL
  ), candidate AS MATERIALIZED (
    SELECT question.loop_id, latest.loop_name, latest.source, latest.loop_type, latest.importance, latest.area, latest.unit, latest.description, latest.owner,
           said.*, kind.weight AS kind_weight, question.loop_p, question.threshold, question.fault_probability, notice.since AS stay_since, latest.slot_end AS newest_slot,
           -- What a perfect linear controller could win; the middle where the index is unknown; all where the measurement is dead.
           CASE WHEN said.dead THEN 1 WHEN said.harris_low IS NULL OR said.harris_high IS NULL THEN 0.5
                ELSE least(greatest(1 - (said.harris_low + said.harris_high) / 2, 0), 1) END AS severity
    FROM question
    JOIN loopscope.latest_verdict AS latest USING (loop_id)
    LEFT JOIN loopscope.flag_notice AS notice USING (flag_notice_id)
    -- The newest window, or, where that names no fault, the last of the stay that did; if no row of it is left, what was noted.
    LEFT JOIN LATERAL loopscope.last_fault(question.loop_id, CASE WHEN question.is_fault THEN latest.slot_end ELSE notice.slot_end END, latest.slot_end) AS place ON true
    LEFT JOIN LATERAL (
      SELECT * FROM loopscope.verdict AS v
      WHERE v.loop_id = question.loop_id AND v.slot_end = place.slot_end AND v.algorithm_revision = place.algorithm_revision AND v.input_revision = place.input_revision
      LIMIT 1) AS given ON true
    LEFT JOIN LATERAL (
      SELECT * FROM loopscope.analysis AS a
      WHERE a.loop_id = question.loop_id AND a.slot_end = place.slot_end AND a.algorithm_revision = place.algorithm_revision LIMIT 1) AS analysis ON true
    CROSS JOIN LATERAL (
      SELECT question.shown_code AS code, coalesce(given.confidence, notice.confidence) AS confidence, given.p, coalesce(given.slot_end, notice.slot_end) AS slot_end,
             coalesce(given.algorithm_revision, latest.algorithm_revision) AS algorithm_revision, coalesce(given.input_revision, latest.input_revision) AS input_revision,
             coalesce(given.analysis_id, latest.analysis_id) AS analysis_id, coalesce(given.summary, notice.summary) AS summary,
             coalesce(given.reasons, '{}') AS reasons, coalesce(given.action, '') AS action, analysis.nonlinear_p, analysis.ngi, analysis.nli, analysis.oscillation_period_s,
             analysis.harris_low, analysis.harris_high, coalesce(question.is_fault AND question.shown_code = 'sensor_fault' AND 'pv_dead' = ANY (analysis.flags), false) AS dead,
             analysis.combined_probabilities[array_position(
               '{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,nonlinear_unexplained}'::text[],
               question.shown_code)]::double precision AS combined_confidence) AS said
    JOIN loopscope.verdict_kind AS kind ON kind.code = said.code
  ), caused AS (
    SELECT source_loop_id, min(number) AS number, max(holds_until) AS holds_until
    FROM loopscope.current_plant_oscillation GROUP BY source_loop_id
  )
  SELECT row_number() OVER (ORDER BY dead DESC, severity * importance * kind_weight * coalesce(combined_confidence, confidence) DESC, candidate.loop_id) AS rank,
         candidate.loop_id, loop_name, source, loop_type, code,
         severity * importance * kind_weight * coalesce(combined_confidence, confidence) AS score,
         severity, importance, kind_weight, confidence, p, threshold, nonlinear_p,
         slot_end, algorithm_revision, input_revision, analysis_id, summary, reasons, action,
         ngi, nli, oscillation_period_s, harris_low, harris_high,
         CASE WHEN run.confirmed THEN 'confirmed' ELSE 'watch' END AS status, coalesce(least(run.since, stay_since), candidate.slot_end), caused.number,
         combined_confidence, fault_probability, area, unit, description, owner
  FROM candidate
  LEFT JOIN LATERAL loopscope.verdict_run(candidate.loop_id, candidate.slot_end, candidate.code) AS run ON true
  LEFT JOIN caused ON caused.source_loop_id = candidate.loop_id AND candidate.newest_slot <= caused.holds_until
  ORDER BY rank;
END;
-- Views of a site's own, and rights of persons, stay: the view keeps its columns, the function its name.
CREATE OR REPLACE VIEW loopscope.flagged_loop AS SELECT * FROM loopscope.list_at();
DROP FUNCTION loopscope.flagged_at(double precision, double precision, double precision);
ALTER FUNCTION loopscope.list_at RENAME TO flagged_at;
COMMENT ON FUNCTION loopscope.flagged_at(double precision, double precision, double precision) IS 'What flagged_loop would be at other thresholds: false_discovery_rate, false_discovery_dependence, min_confidence; null = as they are set. With one that is given, no loop stays: whoever would enter is flagged';
COMMENT ON VIEW loopscope.flagged_loop IS 'Loops that somebody should act on, dead measurements first, then by score. A fault of an enabled loop enters while the expected share of loops without a fault on the list is below list_false_share and it is a fact or passes the false-discovery control; it stays until that share exceeds list_leave_share, and is gone at once when annotated away or found to be the victim of a shared oscillation';
COMMENT ON COLUMN loopscope.flagged_loop.severity IS '1 minus the middle of the Harris index, 0 to 1; 0.5 where that is unknown, 1 where the measurement stands still';
COMMENT ON COLUMN loopscope.flagged_loop.since IS 'Slot of the first verdict of the unbroken run of this code, or of the stay on the list, the earlier one';
COMMENT ON COLUMN loopscope.flagged_loop.false_discovery_threshold IS 'Largest p of a loop (p times its tests) that enters today; null = none does, only facts';
COMMENT ON COLUMN loopscope.flagged_loop.area IS 'Area of the plant; null = not said'; COMMENT ON COLUMN loopscope.flagged_loop.unit IS 'Process unit within the area; null = not said';
COMMENT ON COLUMN loopscope.flagged_loop.description IS 'What the loop controls, in words; null = not said'; COMMENT ON COLUMN loopscope.flagged_loop.owner IS 'Who looks after the loop; null = not said';

CREATE OR REPLACE VIEW loopscope.hidden_loop AS
  WITH question AS MATERIALIZED (SELECT * FROM loopscope.list_questions()),
  likeliest AS (  -- of the causes behind healthy, whatever the verdict
    SELECT latest.loop_id, cause.name, cause.probability
    FROM loopscope.latest_verdict AS latest
    CROSS JOIN LATERAL (
      SELECT weighed.name, weighed.probability::double precision
      FROM unnest('{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,nonlinear_unexplained}'::text[],
                  coalesce(latest.combined_probabilities, latest.cause_probabilities)) AS weighed (name, probability)
      WHERE weighed.name <> 'healthy' AND weighed.probability IS NOT NULL
      ORDER BY weighed.name = latest.code DESC, weighed.probability DESC LIMIT 1) AS cause
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
           CASE WHEN NOT question.rare AND question.is_fault AND question.within_share AND coalesce(question.fault_probability, 1) >= 0.5 THEN 'chance' ELSE 'probability' END AS hidden_by,
           CASE WHEN NOT question.rare AND question.is_fault AND question.within_share AND coalesce(question.fault_probability, 1) >= 0.5
                THEN 'as strong evidence is found by chance too often among so many loops (p ' || trim(to_char(question.loop_p, '9.9EEEE'))
                     || coalesce(', at most ' || trim(to_char(question.bound, '9.9EEEE')) || ' would do', '') || ')'
                ELSE 'not sure enough for the list (probability ' || round(likeliest.probability::numeric, 2) || ')' END AS reason
    FROM question JOIN likeliest USING (loop_id)
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
COMMENT ON VIEW loopscope.hidden_loop IS 'Every enabled loop where a fault has a probability of at least min_confidence and that is not on the list: one row per thing that keeps it from there, by what or whom, why and until when';
COMMENT ON COLUMN loopscope.hidden_loop.hidden_by IS 'acknowledged, suppressed, false_positive, victim, probability (not sure enough) or chance (evidence as strong is too common)';
COMMENT ON COLUMN loopscope.hidden_loop.cause IS 'The verdict, or where that names no fault the likeliest one';
COMMENT ON COLUMN loopscope.hidden_loop.probability IS 'Its probability by all windows';
COMMENT ON COLUMN loopscope.hidden_loop.area IS 'Area of the plant; null = not said'; COMMENT ON COLUMN loopscope.hidden_loop.unit IS 'Process unit within the area; null = not said';
COMMENT ON COLUMN loopscope.hidden_loop.description IS 'What the loop controls, in words; null = not said'; COMMENT ON COLUMN loopscope.hidden_loop.owner IS 'Who looks after the loop; null = not said';

-- What views call is called with the rights of whoever asks.
ALTER FUNCTION loopscope.grant_rights() RENAME TO grant_rights_of_0023;
CREATE FUNCTION loopscope.grant_rights() RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
DECLARE grantee text;
BEGIN
  PERFORM loopscope.grant_rights_of_0023();
  FOREACH grantee IN ARRAY '{loopscope_worker,loopscope_reader,loopscope_engineer}'::text[] LOOP
    CONTINUE WHEN to_regrole(grantee) IS NULL;
    EXECUTE 'GRANT EXECUTE ON FUNCTION loopscope.list_questions, loopscope.last_fault TO ' || grantee;
  END LOOP;
END $$;
COMMENT ON FUNCTION loopscope.grant_rights_of_0023() IS 'The part of grant_rights() that stood before the list asked its questions in a function of their own';
COMMENT ON FUNCTION loopscope.grant_rights() IS 'Gives loopscope_worker, loopscope_reader and loopscope_engineer, where they exist, exactly the rights that they need, and takes every other one back';
