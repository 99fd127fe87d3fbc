-- What work is planned by: the list of loops that need action, what hides a loop from it, and what came of
-- repairs.

-- The run of a verdict. Late rows replace the verdict of a slot: its newest revision counts. A slot that could not be
-- judged, or in which no controller acted, says nothing of a fault, and so neither breaks a run nor belongs to it.
CREATE OR REPLACE FUNCTION loopscope.verdict_run(of_loop bigint, newest_slot timestamptz, of_code text)
RETURNS TABLE (since timestamptz, confirmed boolean) LANGUAGE sql STABLE
BEGIN ATOMIC
  -- The key's index, which holds the code, is read in order up to the row that decides; of few rows revisions are
  -- asked.
  WITH other AS (
    SELECT given.slot_end FROM loopscope.verdict AS given
    WHERE given.loop_id = of_loop AND given.slot_end < newest_slot AND given.code <> of_code
      AND given.code NOT IN ('insufficient_data', 'not_controlling')
      AND (SELECT newest.code FROM loopscope.verdict AS newest
           WHERE newest.loop_id = of_loop AND newest.slot_end = given.slot_end
           ORDER BY newest.algorithm_revision DESC, newest.input_revision DESC LIMIT 1)
          NOT IN (of_code, 'insufficient_data', 'not_controlling')
    ORDER BY given.slot_end DESC LIMIT 1
  ), first AS (
    SELECT given.slot_end FROM loopscope.verdict AS given
    WHERE given.loop_id = of_loop AND given.slot_end <= newest_slot AND given.code = of_code
      AND given.slot_end > coalesce((SELECT slot_end FROM other), '-infinity')
      AND (SELECT newest.code FROM loopscope.verdict AS newest
           WHERE newest.loop_id = of_loop AND newest.slot_end = given.slot_end
           ORDER BY newest.algorithm_revision DESC, newest.input_revision DESC LIMIT 1) = of_code
    ORDER BY given.slot_end LIMIT 1
  )
  SELECT first.slot_end,
         -- window_end is the last sample of a window, window_start the first.
         coalesce((SELECT newest.window_start FROM loopscope.analysis AS newest
                   WHERE newest.loop_id = of_loop AND newest.slot_end = newest_slot
                   ORDER BY newest.algorithm_revision DESC LIMIT 1)
                  > (SELECT oldest.window_end FROM loopscope.analysis AS oldest
                     WHERE oldest.loop_id = of_loop AND oldest.slot_end = first.slot_end
                     ORDER BY oldest.algorithm_revision DESC LIMIT 1), false)
  FROM first;
END;
COMMENT ON FUNCTION loopscope.verdict_run(bigint, timestamp with time zone, text) IS
  'Of the verdict of_code that the loop has at newest_slot: the slot since which it was given without another one in '
  'between, and whether it is confirmed by a window that shares no sample with the first one of the run';

-- Of a stay whose newest window names no fault the last one that did, by the newest revision of each slot.
CREATE OR REPLACE FUNCTION loopscope.last_fault(of_loop bigint, from_slot timestamptz, to_slot timestamptz)
RETURNS TABLE (slot_end timestamptz, algorithm_revision integer, input_revision integer, code text) LANGUAGE sql STABLE
BEGIN ATOMIC
  SELECT given.slot_end, given.algorithm_revision, given.input_revision, given.code FROM loopscope.verdict AS given
  WHERE given.loop_id = of_loop AND given.slot_end BETWEEN from_slot AND to_slot
    AND given.code NOT IN ('healthy', 'not_controlling', 'insufficient_data')
    AND NOT EXISTS (
      SELECT FROM loopscope.verdict AS newer
      WHERE newer.loop_id = of_loop AND newer.slot_end = given.slot_end
        AND (newer.algorithm_revision, newer.input_revision) > (given.algorithm_revision, given.input_revision))
  ORDER BY given.slot_end DESC LIMIT 1;
END;
COMMENT ON FUNCTION loopscope.last_fault(bigint, timestamp with time zone, timestamp with time zone) IS
  'The last slot of a span whose verdict, by its newest revision, names a fault';

CREATE OR REPLACE VIEW loopscope.annotation_history AS
  SELECT annotation_id, loop_id, loop.name AS loop_name, kind, code, until, reason, author, entered_at,
         withdrawn_at, withdrawn_by,
         CASE WHEN withdrawn_at IS NOT NULL THEN 'withdrawn' WHEN until <= now() THEN 'ended'
              -- The work that was planned is done, and a window that lies after it was looked at.
              WHEN kind = 'acknowledged' AND EXISTS (
                SELECT FROM loopscope.maintenance_event AS work JOIN loopscope.analysis AS newer USING (loop_id)
                WHERE work.loop_id = annotation.loop_id AND work.done_at > annotation.entered_at
                  AND newer.slot_end > work.done_at AND newer.window_start >= work.done_at) THEN 'ended'
              ELSE 'in_force' END AS state
  FROM loopscope.annotation JOIN loopscope.loop USING (loop_id);
COMMENT ON VIEW loopscope.annotation_history IS
  'One row per annotation that was ever made: what was said of which loop, by whom, whether it still holds';
COMMENT ON COLUMN loopscope.annotation_history.annotation_id IS 'Number of the annotation; null = none, a victim';
COMMENT ON COLUMN loopscope.annotation_history.code IS 'Verdict that is hidden; null = whatever the verdict';
COMMENT ON COLUMN loopscope.annotation_history.until IS
  'When it ends; null = when it is withdrawn, or the next plant round';
COMMENT ON COLUMN loopscope.annotation_history.reason IS 'Why';
COMMENT ON COLUMN loopscope.annotation_history.author IS 'Who entered it; null = the program';
COMMENT ON COLUMN loopscope.annotation_history.state IS
  'in_force, ended (its time is over; an acknowledged fault: work was done since, and a window lies after it) or '
  'withdrawn';

CREATE OR REPLACE VIEW loopscope.annotation_in_force AS
  SELECT annotation_id, loop_id, loop_name, kind, code, until, reason, author, entered_at
  FROM loopscope.annotation_history WHERE state = 'in_force';
COMMENT ON VIEW loopscope.annotation_in_force IS 'Annotations that hold now';

-- Everything that keeps a fault from the list, whoever wants it so: this is the only place.
CREATE OR REPLACE VIEW loopscope.hiding AS
  SELECT loop_id, kind AS hidden_by, code, NULL::timestamptz AS last_slot, annotation_id, until, reason, author,
         entered_at, NULL::integer AS plant_oscillation_number, NULL::text AS source_loop_name
  FROM loopscope.annotation_in_force
  UNION ALL
  SELECT member.loop_id, 'victim', NULL, current.holds_until, NULL, NULL, current.statement, NULL, current.found_at,
         current.number, current.source_loop_name
  FROM loopscope.current_plant_oscillation AS current
  CROSS JOIN LATERAL unnest(current.loop_ids, current.roles) AS member (loop_id, role)
  -- The other loop of a cascade is a victim too. Whoever causes one oscillation is not excused by being the victim of
  -- another.
  WHERE member.role IN ('victim', 'cascade_slave', 'cascade_master')
    AND member.loop_id NOT IN (SELECT source_loop_id FROM loopscope.current_plant_oscillation
                               WHERE source_loop_id IS NOT NULL)
    -- Whoever calls what was found of the source false wants to see the others again.
    AND NOT EXISTS (SELECT FROM loopscope.annotation_in_force AS said
                    JOIN loopscope.own_verdict AS latest USING (loop_id)
                    WHERE said.loop_id = current.source_loop_id AND said.kind = 'false_positive'
                      AND coalesce(said.code, latest.code) = latest.code);
COMMENT ON VIEW loopscope.hiding IS
  'What hides verdicts from flagged_loop: annotations that hold, and being the victim of a shared oscillation; '
  'hidden_loop shows what is hidden by it';
COMMENT ON COLUMN loopscope.hiding.hidden_by IS 'acknowledged, suppressed, false_positive or victim';
COMMENT ON COLUMN loopscope.hiding.last_slot IS 'Verdicts of later slots are not hidden; null = all are';
COMMENT ON COLUMN loopscope.hiding.plant_oscillation_number IS
  'Oscillation that the loop is the victim of; null = an annotation';

-- One row per analysed, enabled loop: what the list asks of it. Whether a fault is probable: loops in the order of how
-- probable one is, as long as the mean of what is left to doubt stays below the share (Newton et al. 2004), and above
-- a least probability, since behind many sure faults that mean alone would take in what is hardly more likely a fault
-- than not. And the false-discovery control, argued in core/plant/README.md and written a second time in
-- core/plant/false_discovery: whether evidence as strong is rare among loops without that fault. Its family is the
-- loops: each asks the plant one question, whether its fault is chance, with one p, that of its verdict times the
-- tests that it may have been picked from. What hides a verdict hides it before both questions, and leaves the family
-- as large as it was. A verdict without probabilities (a program of before, a loop that is not in command) is asked
-- the second alone. A loop enters at one rate and leaves at a second, looser one, so that the list stands still;
-- whoever is more likely sound than faulty leaves it, however sure the other faults on it are. Windows are counted by
-- their rows: what is remembered of them depends on how long that is, and on how many have a model.
CREATE OR REPLACE FUNCTION loopscope.list_questions(
  rate float8 DEFAULT NULL, dependence float8 DEFAULT NULL, least_confidence float8 DEFAULT NULL)
RETURNS TABLE (
  loop_id bigint, is_fault boolean, shown_code text, hidden boolean, fault_probability float8,
  probability_of_code float8, loop_p float8, threshold float8, bound float8, within_share boolean, rare boolean,
  enters boolean, flag_notice_id bigint, stays boolean) LANGUAGE sql STABLE
BEGIN ATOMIC
  WITH setting AS (
    SELECT coalesce(rate, max(value) FILTER (WHERE name = 'false_discovery_rate')) AS false_discovery_rate,
           max(value) FILTER (WHERE name = 'list_false_share') AS list_false_share,
           max(value) FILTER (WHERE name = 'list_leave_share') AS list_leave_share,
           max(value) FILTER (WHERE name = 'list_least_probability') AS list_least_probability,
           max(value) FILTER (WHERE name = 'list_leave_probability') AS list_leave_probability,
           max(value) FILTER (WHERE name = 'list_enough_windows') AS list_enough_windows,
           coalesce(dependence,
                    max(value) FILTER (WHERE name = 'false_discovery_dependence')) AS false_discovery_dependence,
           coalesce(least_confidence, max(value) FILTER (WHERE name = 'min_confidence')) AS min_confidence
    FROM loopscope.parameter
  ), held AS (
    SELECT loop_id, array_agg(code) AS codes, bool_or(code IS NULL AND last_slot IS NULL) AS whatever_the_code,
           max(last_slot) AS last_slot
    FROM loopscope.hiding GROUP BY loop_id
  ), stay AS (  -- a program of before may have noted a second one
    SELECT DISTINCT ON (loop_id) loop_id, flag_notice_id, code, slot_end FROM loopscope.flag_notice
    WHERE ended_at IS NULL ORDER BY loop_id, flagged_at, flag_notice_id
  ), asked AS MATERIALIZED (
    SELECT latest.loop_id, latest.code, kind.is_fault, latest.fault_probability, latest.p, latest.algorithm_revision,
           latest.window_end, latest.window_end - latest.window_start AS window_length,
           coalesce(latest.combined_confidence, latest.confidence) AS probability_of_code,
           -- A verdict that rests on a test belongs to the family even if its analysis shows none.
           -- A model that may claim something makes two: of the next effect, and of what is left.
           greatest(CASE WHEN latest.usable
                         THEN num_nonnulls(latest.nonlinear_p, latest.oscillation_p, latest.harris_p)
                              + CASE WHEN latest.model_excited THEN 2 ELSE 0 END
                         ELSE 0 END, num_nonnulls(latest.p)) AS tests,
           seen.code AS shown_code,
           coalesce(held.whatever_the_code OR seen.code = ANY (held.codes)
                    OR latest.slot_end <= held.last_slot, false) AS hidden,
           stay.flag_notice_id
    FROM loopscope.own_verdict AS latest JOIN loopscope.verdict_kind AS kind USING (code)
    LEFT JOIN held USING (loop_id) LEFT JOIN stay USING (loop_id)
    LEFT JOIN LATERAL loopscope.last_fault(stay.loop_id, stay.slot_end, latest.slot_end) AS last
      ON NOT kind.is_fault AND stay.flag_notice_id IS NOT NULL
    -- What the list says of it.
    CROSS JOIN LATERAL (
      SELECT CASE WHEN kind.is_fault THEN latest.code
                  ELSE coalesce(last.code, stay.code, latest.code) END AS code) AS seen
    WHERE latest.enabled
  ), shown AS MATERIALIZED (
    SELECT asked.*,
           asked.is_fault AND asked.probability_of_code >= setting.min_confidence AND NOT asked.hidden AS shown,
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
    SELECT loop_id,
           doubt <= setting.list_false_share
           AND fault_probability >= setting.list_least_probability AS within_share
    FROM (SELECT loop_id, fault_probability, avg(1 - fault_probability) OVER (ORDER BY fault_probability DESC) AS doubt
          FROM shown WHERE shown AND fault_probability IS NOT NULL) AS ordered CROSS JOIN setting
  ), kept AS (
    SELECT loop_id,
           doubt <= setting.list_leave_share
           AND fault_probability >= greatest(setting.min_confidence, setting.list_leave_probability)
             AS within_leave_share
    FROM (SELECT loop_id, fault_probability, avg(1 - fault_probability) OVER (ORDER BY fault_probability DESC) AS doubt
          FROM shown WHERE (shown OR may_stay) AND fault_probability IS NOT NULL) AS ordered CROSS JOIN setting
  ), answered AS (
    SELECT shown.*, control.threshold,
           setting.false_discovery_rate * (coalesce(control.passing, 0) + 1) / nullif(scale.scaled_m, 0) AS bound,
           coalesce(listed.within_share, true) AS within_share,
           shown.p IS NULL OR shown.loop_p <= control.threshold OR setting.false_discovery_rate >= 1
             -- Another one that shares no sample and is not forgotten yet.
             OR (shown.shown AND shown.fault_probability IS NOT NULL AND EXISTS (
                   SELECT FROM loopscope.analysis AS earlier
                   WHERE earlier.loop_id = shown.loop_id AND earlier.algorithm_revision = shown.algorithm_revision
                     AND earlier.combined_windows IS NOT NULL
                     AND earlier.slot_end > shown.window_end - 7.5 * shown.window_length
                     AND earlier.window_end > shown.window_end - 7.5 * shown.window_length
                     AND earlier.window_end
                         <= shown.window_end - (setting.list_enough_windows - 1) * shown.window_length)) AS rare,
           -- A window that could not be judged says nothing: whoever is on the list stays.
           may_stay AND CASE WHEN shown.fault_probability IS NULL THEN shown.shown OR shown.code = 'insufficient_data'
                             ELSE kept.within_leave_share END AS stays
    FROM shown LEFT JOIN listed USING (loop_id) LEFT JOIN kept USING (loop_id)
    CROSS JOIN control CROSS JOIN scale CROSS JOIN setting
  )
  SELECT loop_id, is_fault, shown_code, hidden, fault_probability, probability_of_code, loop_p, threshold, bound,
         within_share, coalesce(rare, false),
         shown AND within_share AND coalesce(rare, false), flag_notice_id, coalesce(stays, false)
  FROM answered;
END;
COMMENT ON FUNCTION loopscope.list_questions(double precision, double precision, double precision) IS
  'What the list asks of each analysed, enabled loop, and whether it enters or stays; shown_code = the verdict, or, '
  'of a stay whose newest window names no fault, the last that did; thresholds as in flagged_at(); threshold = the '
  'largest loop_p that passes the control, bound = what one more would have to be below';

-- The list, at any thresholds. Other thresholds than those that are set have no stays: what would be flagged is what
-- would enter.
CREATE OR REPLACE FUNCTION loopscope.flagged_at(
  rate float8 DEFAULT NULL, dependence float8 DEFAULT NULL, least_confidence float8 DEFAULT NULL)
RETURNS TABLE (
  rank bigint, loop_id bigint, loop_name text, source text, loop_type text, code text, score float8, severity float8,
  importance float8, kind_weight float8, confidence float8, p float8, false_discovery_threshold float8,
  nonlinear_p float8, slot_end timestamptz, algorithm_revision integer, input_revision integer, analysis_id bigint,
  summary text, reasons text[], action text, ngi float8, nli float8, oscillation_period_s float8, harris_low float8,
  harris_high float8, status text, since timestamptz, plant_oscillation_number integer, combined_confidence float8,
  fault_probability float8, area text, unit text, description text, owner text) LANGUAGE sql STABLE
BEGIN ATOMIC
  WITH question AS MATERIALIZED (
    SELECT * FROM loopscope.list_questions(rate, dependence, least_confidence)
    WHERE enters OR stays AND rate IS NULL AND dependence IS NULL AND least_confidence IS NULL
  ), candidate AS MATERIALIZED (
    SELECT question.loop_id, latest.loop_name, latest.source, latest.loop_type, latest.importance, latest.area,
           latest.unit, latest.description, latest.owner,
           said.*, kind.weight AS kind_weight, question.loop_p, question.threshold, question.fault_probability,
           notice.since AS stay_since, latest.slot_end AS newest_slot,
           -- What a perfect linear controller could win; the middle where the index is unknown; all where the
           -- measurement is dead.
           CASE WHEN said.dead THEN 1 WHEN said.harris_low IS NULL OR said.harris_high IS NULL THEN 0.5
                ELSE least(greatest(1 - (said.harris_low + said.harris_high) / 2, 0), 1) END AS severity
    FROM question
    JOIN loopscope.own_verdict AS latest USING (loop_id)
    LEFT JOIN loopscope.flag_notice AS notice USING (flag_notice_id)
    -- The newest window, or, where that names no fault, the last of the stay that did; if no row of it is left, what
    -- was noted.
    LEFT JOIN LATERAL loopscope.last_fault(
      question.loop_id, CASE WHEN question.is_fault THEN latest.slot_end ELSE notice.slot_end END,
      latest.slot_end) AS place ON true
    LEFT JOIN LATERAL (
      SELECT * FROM loopscope.verdict AS v
      WHERE v.loop_id = question.loop_id AND v.slot_end = place.slot_end
        AND v.algorithm_revision = place.algorithm_revision AND v.input_revision = place.input_revision
      LIMIT 1) AS given ON true
    LEFT JOIN LATERAL (
      SELECT * FROM loopscope.analysis AS a
      WHERE a.loop_id = question.loop_id AND a.slot_end = place.slot_end
        AND a.algorithm_revision = place.algorithm_revision LIMIT 1) AS analysis ON true
    CROSS JOIN LATERAL (
      SELECT question.shown_code AS code, coalesce(given.confidence, notice.confidence) AS confidence, given.p,
             coalesce(given.slot_end, notice.slot_end) AS slot_end,
             coalesce(given.algorithm_revision, latest.algorithm_revision) AS algorithm_revision,
             coalesce(given.input_revision, latest.input_revision) AS input_revision,
             coalesce(given.analysis_id, latest.analysis_id) AS analysis_id,
             coalesce(given.summary, notice.summary) AS summary, coalesce(given.reasons, '{}') AS reasons,
             coalesce(given.action, '') AS action, analysis.nonlinear_p, analysis.ngi, analysis.nli,
             analysis.oscillation_period_s, analysis.harris_low, analysis.harris_high,
             coalesce(question.is_fault AND question.shown_code = 'sensor_fault'
                      AND 'pv_dead' = ANY (analysis.flags), false) AS dead,
             analysis.combined_probabilities[array_position(
               '{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,'
               'process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,'
               'nonlinear_unexplained}'::text[],
               question.shown_code)]::double precision AS combined_confidence) AS said
    JOIN loopscope.verdict_kind AS kind ON kind.code = said.code
  ), caused AS (
    SELECT source_loop_id, min(number) AS number, max(holds_until) AS holds_until
    FROM loopscope.current_plant_oscillation GROUP BY source_loop_id
  )
  SELECT row_number() OVER (
           ORDER BY dead DESC, severity * importance * kind_weight * coalesce(combined_confidence, confidence) DESC,
                    candidate.loop_id) AS rank,
         candidate.loop_id, loop_name, source, loop_type, code,
         severity * importance * kind_weight * coalesce(combined_confidence, confidence) AS score,
         severity, importance, kind_weight, confidence, p, threshold, nonlinear_p,
         slot_end, algorithm_revision, input_revision, analysis_id, summary, reasons, action,
         ngi, nli, oscillation_period_s, harris_low, harris_high,
         CASE WHEN run.confirmed THEN 'confirmed' ELSE 'watch' END AS status,
         coalesce(least(run.since, stay_since), candidate.slot_end), caused.number,
         combined_confidence, fault_probability, area, unit, description, owner
  FROM candidate
  LEFT JOIN LATERAL loopscope.verdict_run(candidate.loop_id, candidate.slot_end, candidate.code) AS run ON true
  LEFT JOIN caused ON caused.source_loop_id = candidate.loop_id AND candidate.newest_slot <= caused.holds_until
  ORDER BY rank;
END;
COMMENT ON FUNCTION loopscope.flagged_at(double precision, double precision, double precision) IS
  'What flagged_loop would be at other thresholds: false_discovery_rate, false_discovery_dependence, min_confidence; '
  'null = as they are set. With one that is given, no loop stays: whoever would enter is flagged';

CREATE OR REPLACE VIEW loopscope.flagged_loop AS SELECT * FROM loopscope.flagged_at();
COMMENT ON VIEW loopscope.flagged_loop IS
  'Loops that need action, dead measurements first, then by score. A fault of an enabled loop enters while '
  'the expected share of loops without a fault on the list is below list_false_share and it is probable '
  '(list_least_probability), if it is a fact, passes the false-discovery control or stands behind list_enough_windows '
  'windows; it stays until that share exceeds list_leave_share or a fault is less probable than '
  'list_leave_probability, and is gone at once when annotated away or found to be the victim of a shared oscillation';
COMMENT ON COLUMN loopscope.flagged_loop.rank IS '1 = act here first';
COMMENT ON COLUMN loopscope.flagged_loop.code IS 'The verdict; verdict_kind explains every code';
COMMENT ON COLUMN loopscope.flagged_loop.score IS
  'severity x importance x kind_weight x combined_confidence (confidence where there is none)';
COMMENT ON COLUMN loopscope.flagged_loop.severity IS
  '1 minus the middle of the Harris index, 0 to 1; 0.5 where that is unknown, 1 where the measurement stands still';
COMMENT ON COLUMN loopscope.flagged_loop.kind_weight IS 'Weight of the kind of fault (parameter weight_...)';
COMMENT ON COLUMN loopscope.flagged_loop.false_discovery_threshold IS
  'Largest p of a loop (p times its tests) that enters today by its newest window; null = none does, only facts and '
  'what several windows show';
COMMENT ON COLUMN loopscope.flagged_loop.status IS
  'watch = new; confirmed = the same verdict came in a second window that shares no sample with the first one of its '
  'run';
COMMENT ON COLUMN loopscope.flagged_loop.since IS
  'Slot of the first verdict of the unbroken run of this code, or of the stay on the list, the earlier one';
COMMENT ON COLUMN loopscope.flagged_loop.plant_oscillation_number IS
  'Shared oscillation (current_plant_oscillation) that the loop is the source of; null = none';

-- In plain words what keeps a loop off the list, and what will decide. The newest verdict is told as the cause only
-- where it is probable enough.
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
           hiding.annotation_id, hiding.plant_oscillation_number, hiding.source_loop_name
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
                THEN 'not sure enough for the list (probability '
                     || round(coalesce(question.fault_probability, likeliest.probability)::numeric, 2) || ')'
                     || CASE WHEN question.fault_probability >= list_least.value
                             THEN ': with the surer ones, more than '
                                  || round((100 * list_false.value)::numeric, 1)::float8
                                  || ' % of the list would be no fault'
                             ELSE '' END
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
    SELECT loop_id, hidden_by, NULL, reason, NULL, NULL, NULL, NULL, NULL FROM unlisted
  )
  SELECT latest.loop_id, latest.loop_name, latest.code, latest.confidence, latest.slot_end, latest.summary,
         hidden.hidden_by, hidden.until, hidden.reason, hidden.author, hidden.entered_at, hidden.annotation_id,
         hidden.plant_oscillation_number, hidden.source_loop_name,
         likeliest.name AS cause, likeliest.probability, latest.area, latest.unit, latest.description, latest.owner
  FROM hidden
  JOIN loopscope.own_verdict AS latest USING (loop_id)
  LEFT JOIN likeliest USING (loop_id)
  WHERE latest.enabled;
COMMENT ON VIEW loopscope.hidden_loop IS
  'Every enabled loop where a fault has a probability of at least min_confidence and that is not on the list: one row '
  'per thing that keeps it from there, by what or whom, why and until when';
COMMENT ON COLUMN loopscope.hidden_loop.confidence IS 'Confidence of that verdict, 0 to 1';
COMMENT ON COLUMN loopscope.hidden_loop.slot_end IS 'Slot of the verdict that was flagged first';
COMMENT ON COLUMN loopscope.hidden_loop.summary IS 'What was said of it';
COMMENT ON COLUMN loopscope.hidden_loop.hidden_by IS
  'acknowledged, suppressed, false_positive, victim, probability (not sure enough) or chance (evidence as strong is '
  'too common)';
COMMENT ON COLUMN loopscope.hidden_loop.plant_oscillation_number IS
  'Oscillation that the loop is the victim of; null = an annotation';
COMMENT ON COLUMN loopscope.hidden_loop.cause IS 'The verdict, or where that names no fault the likeliest one';
COMMENT ON COLUMN loopscope.hidden_loop.probability IS 'Its probability by all windows';

CREATE OR REPLACE VIEW loopscope.flag_history AS
  SELECT flag_notice_id, loop_id, loop.name AS loop_name, code, flagged_at, since, status, confirmed_at, ended_at,
         ended_by, ended_at IS NULL AS stands, announced, slot_end, confidence, rank, score, summary
  FROM loopscope.flag_notice JOIN loopscope.loop USING (loop_id);
COMMENT ON VIEW loopscope.flag_history IS
  'One row per stay of a loop on the list: when it came, as what, when and why it left';
COMMENT ON COLUMN loopscope.flag_history.ended_by IS
  'What ended it: verdict (another one), annotation, plant (found to be a victim), disabled, or threshold';
COMMENT ON COLUMN loopscope.flag_history.stands IS 'Whether it is still flagged';
COMMENT ON COLUMN loopscope.flag_history.slot_end IS 'Slot of the verdict that was flagged first';
COMMENT ON COLUMN loopscope.flag_history.confidence IS 'Confidence of that verdict, 0 to 1';
COMMENT ON COLUMN loopscope.flag_history.summary IS 'What was said of it';

-- Faults that one repair removes, and that the diagnosis may take for each other.
CREATE OR REPLACE VIEW loopscope.fault_family (code, family, is_hardware) AS VALUES
  ('valve_stiction', 'friction', true), ('valve_deadband', 'friction', true), ('valve_oversized', 'friction', true),
  ('valve_saturation', 'limit', true), ('sensor_fault', 'sensor', true),
  ('valve_characteristic', 'curve', true), ('process_nonlinearity', 'curve', true),
  ('tight_tuning', 'oscillation', false), ('external_disturbance', 'oscillation', false),
  ('process_change', 'oscillation', false), ('sluggish_tuning', 'slowness', false),
  ('nonlinear_unexplained', 'unknown', false), ('unexplained', 'unknown', false);
COMMENT ON VIEW loopscope.fault_family IS
  'Faults by the repair that removes them: what one repair removes, and what the diagnosis may take for each other, is '
  'one family';
COMMENT ON COLUMN loopscope.fault_family.code IS 'The verdict';
COMMENT ON COLUMN loopscope.fault_family.family IS 'friction, limit, curve, sensor, oscillation, slowness or unknown';
COMMENT ON COLUMN loopscope.fault_family.is_hardware IS 'Whether something of the loop itself is to be repaired';

-- Pieces of work on a loop without a usable window wholly between them are one job: what each of them did cannot be
-- told apart.
CREATE OR REPLACE VIEW loopscope.maintenance_job AS
  SELECT work.maintenance_event_id, work.loop_id, job.*
  FROM loopscope.maintenance_event AS work CROSS JOIN LATERAL (
    SELECT min(done_at) FILTER (WHERE number = own) AS begins_at, max(done_at) FILTER (WHERE number = own) AS ends_at,
           max(done_at) FILTER (WHERE number < own) AS previous_at, min(done_at) FILTER (WHERE number > own) AS next_at
    FROM (SELECT done_at, number, max(number) FILTER (WHERE done_at = work.done_at) OVER () AS own
      FROM (SELECT done_at, count(*) FILTER (WHERE EXISTS (
              SELECT FROM loopscope.analysis WHERE loop_id = work.loop_id AND usable AND slot_end > other.last_at
                AND slot_end <= other.done_at AND window_start >= other.last_at)) OVER (ORDER BY done_at) AS number
            FROM (SELECT done_at, lag(done_at) OVER (ORDER BY done_at) AS last_at FROM loopscope.maintenance_event
                  WHERE loop_id = work.loop_id) AS other) AS counted) AS numbered) AS job;
COMMENT ON VIEW loopscope.maintenance_job IS
  'The job that each piece of work belongs to: work on a loop without a usable window wholly between is one job, and '
  'has one before and after';
COMMENT ON COLUMN loopscope.maintenance_job.begins_at IS 'When the first piece of the job was done';
COMMENT ON COLUMN loopscope.maintenance_job.ends_at IS 'When the last one was done';
COMMENT ON COLUMN loopscope.maintenance_job.previous_at IS 'When the job before it ended; null = there is none';
COMMENT ON COLUMN loopscope.maintenance_job.next_at IS 'When the next one began; null = not yet';

-- Of each side the windows nearest to the work, six at most, none of which shares a sample with another. Each is found
-- by one step along the key from the last one; a year bounds the months that are looked into.
CREATE OR REPLACE VIEW loopscope.maintenance_window AS
  WITH event AS (
    SELECT maintenance_event_id, loop_id, begins_at, ends_at,
           -- Somebody may enter a year that has no year before or after it.
           greatest(previous_at, greatest(begins_at, '1900-01-01') - interval '1 year') AS from_at,
           least(next_at, least(ends_at, '9999-01-01') + interval '1 year') AS to_at
    FROM loopscope.maintenance_job
  ), chosen AS (
    SELECT event.maintenance_event_id, event.loop_id, near.*
    FROM event CROSS JOIN LATERAL (
      WITH RECURSIVE before AS (
        SELECT 1 AS number, newest.* FROM (
          SELECT slot_end, algorithm_revision, window_start FROM loopscope.analysis
          WHERE loop_id = event.loop_id AND slot_end <= event.begins_at AND slot_end > event.from_at
            AND window_start >= event.from_at AND usable
          ORDER BY slot_end DESC, algorithm_revision DESC LIMIT 1) AS newest
        UNION ALL
        SELECT before.number + 1, earlier.* FROM before CROSS JOIN LATERAL (
          SELECT slot_end, algorithm_revision, window_start FROM loopscope.analysis
          WHERE loop_id = event.loop_id AND slot_end < before.window_start AND slot_end > event.from_at
            AND window_start >= event.from_at AND usable
          ORDER BY slot_end DESC, algorithm_revision DESC LIMIT 1) AS earlier
        WHERE before.number < 6
      ), after AS (
        SELECT 1 AS number, first.* FROM (
          SELECT slot_end, algorithm_revision, window_end FROM loopscope.analysis
          WHERE loop_id = event.loop_id AND slot_end > event.ends_at AND slot_end <= event.to_at
            AND window_start >= event.ends_at AND usable
          ORDER BY slot_end, algorithm_revision DESC LIMIT 1) AS first
        UNION ALL
        SELECT after.number + 1, later.* FROM after CROSS JOIN LATERAL (
          SELECT slot_end, algorithm_revision, window_end FROM loopscope.analysis
          WHERE loop_id = event.loop_id AND slot_end > after.window_end AND slot_end <= event.to_at
            AND window_start > after.window_end AND usable
          ORDER BY slot_end, algorithm_revision DESC LIMIT 1) AS later
        WHERE after.number < 6
      )
      SELECT 'before' AS side, number, slot_end, algorithm_revision FROM before
      UNION ALL SELECT 'after', number, slot_end, algorithm_revision FROM after) AS near
  )
  SELECT chosen.maintenance_event_id, chosen.loop_id, chosen.side, chosen.number,
         chosen.slot_end, chosen.algorithm_revision, analysis.input_revision, analysis.analysis_id,
         analysis.window_start, analysis.window_end, verdict.code, verdict.confidence,
         CASE WHEN verdict.confidence >= setting.min_confidence THEN kin.family END AS family,
         analysis.error_std, analysis.error_log_variance_se,
         sqrt(analysis.harris_low) * sqrt(analysis.harris_high) AS harris,
         analysis.ngi, analysis.nli, analysis.nonlinear_p, analysis.oscillating, analysis.oscillation_period_s,
         analysis.oscillation_amplitude, analysis.valve_travel_per_h,
         CASE WHEN pi.fit > 0.9 THEN abs(pi.gain) END AS controller_gain,
         CASE WHEN pi.fit > 0.9 THEN abs(pi.time) END AS integral_time_s
  FROM chosen
  CROSS JOIN LATERAL (
    SELECT * FROM loopscope.analysis AS measured
    WHERE measured.loop_id = chosen.loop_id AND measured.slot_end = chosen.slot_end
      AND measured.algorithm_revision = chosen.algorithm_revision LIMIT 1) AS analysis
  CROSS JOIN LATERAL (
    SELECT * FROM loopscope.verdict AS given
    WHERE given.loop_id = chosen.loop_id AND given.slot_end = chosen.slot_end
      AND given.algorithm_revision = chosen.algorithm_revision AND given.input_revision = analysis.input_revision
    LIMIT 1) AS verdict
  CROSS JOIN LATERAL (
    SELECT (loop->>'controller_fit')::float8 AS fit, (loop->>'controller_gain')::float8 AS gain,
           (loop->>'integral_time_s')::float8 AS time
    FROM (SELECT analysis.model->'closed_loop' AS loop) AS model) AS pi
  LEFT JOIN loopscope.fault_family AS kin ON kin.code = verdict.code
  CROSS JOIN (SELECT max(value) FILTER (WHERE name = 'min_confidence') AS min_confidence
              FROM loopscope.parameter) AS setting;
COMMENT ON VIEW loopscope.maintenance_window IS
  'The windows that before_after_maintenance compares: of each side the nearest to the job, six at most, wholly '
  'between two jobs, none of which shares a sample with another';
COMMENT ON COLUMN loopscope.maintenance_window.side IS 'before or after';
COMMENT ON COLUMN loopscope.maintenance_window.number IS '1 = nearest to the work';
COMMENT ON COLUMN loopscope.maintenance_window.code IS 'The verdict; verdict_kind explains every code';
COMMENT ON COLUMN loopscope.maintenance_window.family IS
  'Family of the fault (fault_family); null = no fault, or less sure than min_confidence';
COMMENT ON COLUMN loopscope.maintenance_window.harris IS 'Harris index, geometric middle of the plausible delays';
COMMENT ON COLUMN loopscope.maintenance_window.controller_gain IS
  'Gain of the PI controller as the loop model reads it from op, absolute; null = op does not follow a PI law';
COMMENT ON COLUMN loopscope.maintenance_window.integral_time_s IS 'Integral time of the PI controller, seconds';

-- What is compared. `ordinary` and `apart` were measured on simulated loops that nobody touched (storage/MEASURED.md).
CREATE OR REPLACE VIEW loopscope.figure_kind
  (figure, effect, parameter, family, is_ratio, ordinary, apart, unit, meaning) AS VALUES
  ('error_std', NULL, NULL, NULL, true, 0.07, 0.12, 'pv units', 'Standard deviation of the error'),
  ('cost', NULL, NULL, NULL, true, 0.12, 0.12, 'pv units',
   'error_std over the root of the Harris index: half of it counts what the error is, '
   'half what a better controller could take away'),
  ('harris', NULL, NULL, NULL, true, 0.15, 0.05, '0 to 1', 'Harris index, middle of the plausible delays'),
  ('ngi', NULL, NULL, NULL, false, 0.0015, 0.0, '', 'Non-Gaussianity index'),
  ('nli', NULL, NULL, NULL, false, 0.03, 0.0, '', 'Nonlinearity index'),
  ('nonlinear_p', NULL, NULL, NULL, false, 1.0, 0.0, 'powers of ten',
   'Evidence for nonlinearity: -log10 of nonlinear_p, at most 30'),
  ('oscillation_share', NULL, NULL, NULL, false, 0.1, 0.1, '0 to 1',
   'Share of the error''s variance that the oscillation carries; 0 = none'),
  ('valve_travel_per_h', NULL, NULL, NULL, true, 0.12, 0.12, '%/h', 'Sum of op movements'),
  ('controller_gain', NULL, NULL, NULL, true, 0.01, 0.01, '%/pv',
   'Gain of the PI controller, as the loop model reads it from op'),
  ('integral_time_s', NULL, NULL, NULL, true, 0.01, 0.01, 's', 'Its integral time'),
  ('valve_stiction.S', 'valve_stiction', 'S', NULL, true, 0.12, 0.08, '% of op', 'Stick band of the valve'),
  ('valve_stiction.J', 'valve_stiction', 'J', NULL, true, 0.3, 0.1, '% of op', 'Slip jump of the valve'),
  ('valve_deadband.width', 'valve_deadband', 'width', NULL, true, 0.12, 0.08, '% of op',
   'Full width of the valve''s play'),
  ('friction_band', 'valve_stiction', 'S', 'friction', true, 0.12, 0.08, '% of op',
   'What the valve loses at a reversal: stick band or play'),
  ('friction_band', 'valve_deadband', 'width', 'friction', true, 0.12, 0.08, '% of op',
   'What the valve loses at a reversal: stick band or play'),
  ('curvature', 'valve_characteristic', 'curvature', 'curve', true, 0.12, 0.08, '', 'Curvature of valve or process'),
  ('curvature', 'process_nonlinearity', 'curvature', 'curve', true, 0.12, 0.08, '', 'Curvature of valve or process'),
  ('valve_saturation.low', 'valve_saturation', 'low', NULL, false, 2.0, 1.0, '% of op', 'Lower limit of the valve'),
  ('valve_saturation.high', 'valve_saturation', 'high', NULL, false, 2.0, 1.0, '% of op', 'Upper limit of the valve'),
  ('external_oscillation.amplitude', 'external_oscillation', 'amplitude', 'oscillation', true, 0.12, 0.08, 'pv units',
   'Amplitude of the sinusoid from outside'),
  ('external_oscillation.period_s', 'external_oscillation', 'period_s', NULL, true, 0.05, 0.05, 's', 'Its period'),
  ('sensor_quantisation.step', 'sensor_quantisation', 'step', 'sensor', true, 0.12, 0.08, 'pv units',
   'Grid of the sensor'),
  ('sensor_hold.samples', 'sensor_hold', 'samples', 'sensor', true, 0.12, 0.08, 'samples',
   'How long the sensor holds a value');
COMMENT ON VIEW loopscope.figure_kind IS 'What maintenance_figure compares, one row per figure and effect that has it';
COMMENT ON COLUMN loopscope.figure_kind.figure IS 'Name of the figure';
COMMENT ON COLUMN loopscope.figure_kind.effect IS
  'Effect of the loop model that has it as a parameter; null = a figure of the window';
COMMENT ON COLUMN loopscope.figure_kind.parameter IS 'Name of the parameter';
COMMENT ON COLUMN loopscope.figure_kind.family IS 'Family of faults whose size it is; null = it sizes none';
COMMENT ON COLUMN loopscope.figure_kind.is_ratio IS 'True: compared as a ratio (by logarithms); false: as a difference';
COMMENT ON COLUMN loopscope.figure_kind.ordinary IS
  'Ordinary standard deviation from window to window, of the logarithm where is_ratio';
COMMENT ON COLUMN loopscope.figure_kind.apart IS
  'Ordinary standard deviation between two states of a loop that nobody touched, whatever the number of windows';
COMMENT ON COLUMN loopscope.figure_kind.unit IS 'Unit';
COMMENT ON COLUMN loopscope.figure_kind.meaning IS 'What it is';

-- Whether a repair worked is judged by the program (core/repair) and stored; the view shows what is stored. The table
-- stands here, and not with the others, because a database that is taken over from the former chain has none.
CREATE TABLE loopscope.repair_judgement (
  maintenance_event_id bigint PRIMARY KEY REFERENCES loopscope.maintenance_event ON DELETE CASCADE,
  algorithm_revision   integer NOT NULL,
  judged_at            timestamptz NOT NULL DEFAULT now(),
  newest_slot_end      timestamptz,
  min_confidence       double precision NOT NULL,
  works                text NOT NULL,
  word                 text CHECK (word IN ('fixed', 'improved', 'unchanged', 'worse')),
  statement            text NOT NULL,
  windows_before       integer NOT NULL CHECK (windows_before >= 0),
  windows_after        integer NOT NULL CHECK (windows_after >= 0),
  fault_before         text,
  fault_after          text,
  variance_ratio       double precision,
  variance_ratio_low   double precision,
  variance_ratio_high  double precision,
  figures              jsonb NOT NULL CHECK (jsonb_typeof(figures) = 'object')
);
COMMENT ON TABLE loopscope.repair_judgement IS
  'What came of each piece of work, as the program judged it; before_after_maintenance shows it';
COMMENT ON COLUMN loopscope.repair_judgement.maintenance_event_id IS 'The piece of work';
COMMENT ON COLUMN loopscope.repair_judgement.algorithm_revision IS 'Revision of the program that judged';
COMMENT ON COLUMN loopscope.repair_judgement.judged_at IS 'When it was judged';
COMMENT ON COLUMN loopscope.repair_judgement.newest_slot_end IS
  'Newest slot of the loop at that time; with another one it is judged again';
COMMENT ON COLUMN loopscope.repair_judgement.min_confidence IS
  'Confidence below which verdicts counted as none (parameter)';
COMMENT ON COLUMN loopscope.repair_judgement.works IS
  'Digest of all work on the loop at that time (numbers and times); with other work it is judged again';
COMMENT ON COLUMN loopscope.repair_judgement.word IS
  'fixed, improved, unchanged or worse; null = cannot be said, statement says why';
COMMENT ON COLUMN loopscope.repair_judgement.statement IS
  'The word in a sentence or two with its figures; without a word, why there is none';
COMMENT ON COLUMN loopscope.repair_judgement.windows_before IS 'Windows before the work that were compared';
COMMENT ON COLUMN loopscope.repair_judgement.windows_after IS 'Windows after the work that were compared';
COMMENT ON COLUMN loopscope.repair_judgement.fault_before IS 'Fault that stands in the windows before; null = none';
COMMENT ON COLUMN loopscope.repair_judgement.fault_after IS 'Fault that stands in the windows after; null = none';
COMMENT ON COLUMN loopscope.repair_judgement.variance_ratio IS
  'Variance of the error after over before; null = one side has none';
COMMENT ON COLUMN loopscope.repair_judgement.variance_ratio_low IS 'Lower end of its 90 % interval';
COMMENT ON COLUMN loopscope.repair_judgement.variance_ratio_high IS 'Upper end of its 90 % interval';
COMMENT ON COLUMN loopscope.repair_judgement.figures IS
  'Every figure by name: {n_before, n_after, before, before_low, before_high, after, ..., is_ratio, change, '
  'change_low, change_high}; maintenance_figure has them as rows';

CREATE OR REPLACE VIEW loopscope.before_after_maintenance AS
  SELECT work.maintenance_event_id, work.loop_id, loop.name AS loop_name, work.done_at, work.kind,
         work.description, before.slot_end AS slot_end_before, after.slot_end AS slot_end_after,
         before.code AS code_before, after.code AS code_after,
         before.error_std AS error_std_before, after.error_std AS error_std_after,
         after.error_std / nullif(before.error_std, 0) AS error_std_ratio,
         before.harris_low AS harris_low_before, after.harris_low AS harris_low_after,
         before.ngi AS ngi_before, after.ngi AS ngi_after,
         before.nli AS nli_before, after.nli AS nli_after,
         before.oscillation_period_s AS oscillation_period_s_before,
         after.oscillation_period_s AS oscillation_period_s_after,
         before.valve_travel_per_h AS valve_travel_per_h_before,
         after.valve_travel_per_h AS valve_travel_per_h_after,
         judged.word,
         coalesce(judged.statement, 'Not judged yet: a running service judges it with its next comparison, '
                                    'a single pass (once) at its end.') AS statement,
         judged.windows_before, judged.windows_after,
         judged.fault_before, judged.fault_after, judged.variance_ratio,
         judged.variance_ratio_low, judged.variance_ratio_high, judged.figures
  FROM loopscope.maintenance_event AS work
  JOIN loopscope.loop USING (loop_id)
  LEFT JOIN loopscope.repair_judgement AS judged USING (maintenance_event_id)
  -- Windows that lie wholly between two jobs: one that straddles them mixes both states.
  CROSS JOIN LATERAL (
    SELECT begins_at, ends_at, coalesce(previous_at, '-infinity') AS previous_at,
           coalesce(next_at, 'infinity') AS next_at
    FROM loopscope.maintenance_job AS job
    WHERE job.maintenance_event_id = work.maintenance_event_id) AS span
  LEFT JOIN LATERAL (
    SELECT code, analysis.* FROM loopscope.analysis
    JOIN loopscope.verdict USING (loop_id, slot_end, algorithm_revision, input_revision)
    WHERE analysis.loop_id = work.loop_id AND analysis.slot_end <= span.begins_at
      AND analysis.window_start >= span.previous_at AND analysis.usable
    ORDER BY analysis.slot_end DESC, analysis.algorithm_revision DESC LIMIT 1) AS before ON true
  LEFT JOIN LATERAL (
    SELECT code, analysis.* FROM loopscope.analysis
    JOIN loopscope.verdict USING (loop_id, slot_end, algorithm_revision, input_revision)
    WHERE analysis.loop_id = work.loop_id AND analysis.slot_end > span.ends_at
      AND analysis.slot_end <= span.next_at AND analysis.window_start >= span.ends_at
      AND analysis.usable
    ORDER BY analysis.slot_end DESC, analysis.algorithm_revision DESC LIMIT 1) AS after ON true;
COMMENT ON VIEW loopscope.before_after_maintenance IS
  'One row per maintenance event: whether the work fixed the loop, by up to six windows on either side; and the '
  'newest usable analysis on either side in figures';
COMMENT ON COLUMN loopscope.before_after_maintenance.kind IS 'valve, sensor, tuning, process or other';
COMMENT ON COLUMN loopscope.before_after_maintenance.description IS 'What was done';
COMMENT ON COLUMN loopscope.before_after_maintenance.slot_end_before IS
  'Slot of the last usable analysis before the work (the figures ..._before); null = none';
COMMENT ON COLUMN loopscope.before_after_maintenance.slot_end_after IS
  'Slot of the newest usable analysis after the work and before the next (the figures ..._after); null = none yet';
COMMENT ON COLUMN loopscope.before_after_maintenance.code_before IS 'Verdict before';
COMMENT ON COLUMN loopscope.before_after_maintenance.code_after IS 'Verdict after';
COMMENT ON COLUMN loopscope.before_after_maintenance.error_std_before IS
  'Standard deviation of the error before, pv units';
COMMENT ON COLUMN loopscope.before_after_maintenance.error_std_after IS
  'Standard deviation of the error after, pv units';
COMMENT ON COLUMN loopscope.before_after_maintenance.error_std_ratio IS 'After over before: below 1 = better';
COMMENT ON COLUMN loopscope.before_after_maintenance.harris_low_before IS 'Harris index (low) before';
COMMENT ON COLUMN loopscope.before_after_maintenance.harris_low_after IS 'Harris index (low) after';
COMMENT ON COLUMN loopscope.before_after_maintenance.ngi_before IS 'Non-Gaussianity index before';
COMMENT ON COLUMN loopscope.before_after_maintenance.ngi_after IS 'Non-Gaussianity index after';
COMMENT ON COLUMN loopscope.before_after_maintenance.nli_before IS 'Nonlinearity index before';
COMMENT ON COLUMN loopscope.before_after_maintenance.nli_after IS 'Nonlinearity index after';
COMMENT ON COLUMN loopscope.before_after_maintenance.oscillation_period_s_before IS
  'Period of the oscillation before, seconds';
COMMENT ON COLUMN loopscope.before_after_maintenance.oscillation_period_s_after IS
  'Period of the oscillation after, seconds';
COMMENT ON COLUMN loopscope.before_after_maintenance.valve_travel_per_h_before IS
  'Sum of op movements before, % of range per hour';
COMMENT ON COLUMN loopscope.before_after_maintenance.valve_travel_per_h_after IS
  'Sum of op movements after, % of range per hour';
COMMENT ON COLUMN loopscope.before_after_maintenance.word IS
  'fixed, improved, unchanged or worse (core/repair/README.md defines them); null = cannot be said, statement says why';
COMMENT ON COLUMN loopscope.before_after_maintenance.statement IS
  'The word in a sentence or two with its figures; without a word, why there is none';
COMMENT ON COLUMN loopscope.before_after_maintenance.windows_before IS
  'Windows before the work that were compared (maintenance_window); null = not judged yet';
COMMENT ON COLUMN loopscope.before_after_maintenance.windows_after IS
  'Windows after the work that were compared (maintenance_window); null = not judged yet';
COMMENT ON COLUMN loopscope.before_after_maintenance.fault_before IS
  'Fault that stands in the windows before: the family with most confidence, where faults have half of all '
  'confidence; null = none';
COMMENT ON COLUMN loopscope.before_after_maintenance.fault_after IS
  'Fault that stands in the windows after: the family with most confidence, where faults have half of all confidence; '
  'null = none';
COMMENT ON COLUMN loopscope.before_after_maintenance.variance_ratio IS
  'Variance of the error after over before, over all compared windows: below 1 = better';
COMMENT ON COLUMN loopscope.before_after_maintenance.variance_ratio_low IS
  'Lower end of its 90 % interval, which holds the ordinary change of a loop that nobody touched';
COMMENT ON COLUMN loopscope.before_after_maintenance.variance_ratio_high IS 'Upper end of its 90 % interval';
COMMENT ON COLUMN loopscope.before_after_maintenance.figures IS
  'Every figure by name, with means, 90 % intervals and numbers of windows; maintenance_figure has them as rows';

CREATE OR REPLACE VIEW loopscope.maintenance_figure AS
  SELECT maintenance_event_id, loop_id, each.figure, kind.unit, kind.meaning, value.n_before AS windows_before,
         value.before, value.before_low, value.before_high,
         value.n_after AS windows_after, value.after, value.after_low, value.after_high,
         value.is_ratio, value.change, value.change_low, value.change_high
  FROM loopscope.before_after_maintenance
  CROSS JOIN LATERAL jsonb_each(figures) AS each (figure, object)
  CROSS JOIN LATERAL jsonb_to_record(object) AS value (
    n_before integer, before float8, before_low float8, before_high float8,
    n_after integer, after float8, after_low float8, after_high float8,
    is_ratio boolean, change float8, change_low float8, change_high float8)
  JOIN (SELECT DISTINCT figure, unit, meaning FROM loopscope.figure_kind) AS kind USING (figure);
COMMENT ON VIEW loopscope.maintenance_figure IS
  'One row per maintenance event and figure: mean before and after, and the change, each with its 90 % interval; ask '
  'for one event';
COMMENT ON COLUMN loopscope.maintenance_figure.figure IS 'Name of the figure (figure_kind)';
COMMENT ON COLUMN loopscope.maintenance_figure.unit IS 'Its unit';
COMMENT ON COLUMN loopscope.maintenance_figure.meaning IS 'What it is';
COMMENT ON COLUMN loopscope.maintenance_figure.windows_before IS 'Windows before the work that have it';
COMMENT ON COLUMN loopscope.maintenance_figure.before IS
  'Mean before the work (geometric where is_ratio); null = no window has it';
COMMENT ON COLUMN loopscope.maintenance_figure.before_low IS 'Lower end of its 90 % interval';
COMMENT ON COLUMN loopscope.maintenance_figure.before_high IS 'Upper end of its 90 % interval';
COMMENT ON COLUMN loopscope.maintenance_figure.windows_after IS 'Windows after the work that have it';
COMMENT ON COLUMN loopscope.maintenance_figure.after IS
  'Mean after the work (geometric where is_ratio); null = no window has it';
COMMENT ON COLUMN loopscope.maintenance_figure.after_low IS 'Lower end of its 90 % interval';
COMMENT ON COLUMN loopscope.maintenance_figure.after_high IS 'Upper end of its 90 % interval';
COMMENT ON COLUMN loopscope.maintenance_figure.is_ratio IS
  'True: change is after over before; false: after less before';
COMMENT ON COLUMN loopscope.maintenance_figure.change IS 'The change; null = one side has no such figure';
COMMENT ON COLUMN loopscope.maintenance_figure.change_low IS
  'Lower end of its 90 % interval, which holds the ordinary change of a loop that nobody touched';
COMMENT ON COLUMN loopscope.maintenance_figure.change_high IS 'Upper end of its 90 % interval';

-- A column without words of its own that is named like another one means the same: take that comment over. Where
-- several have the name, the first of the list speaks.
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT DISTINCT ON (class.oid, shown.attnum) class.relname, shown.attname,
           col_description(source.attrelid, source.attnum) AS words
    FROM pg_class AS class
    JOIN pg_attribute AS shown ON shown.attrelid = class.oid AND shown.attnum > 0
    JOIN unnest('{stage_cost,annotation_history,standing_problem,annotation,own_verdict,analysis,verdict,'
                'flag_notice,loop,current_plant_oscillation,schedule,maintenance_event,plant_oscillation,'
                'explanation_step}'::text[])
      WITH ORDINALITY AS origin (name, priority) ON true
    JOIN pg_attribute AS source
      ON source.attrelid = format('loopscope.%I', origin.name)::regclass AND source.attname = shown.attname
     AND col_description(source.attrelid, source.attnum) IS NOT NULL
    WHERE class.relnamespace = 'loopscope'::regnamespace AND class.relkind IN ('r', 'v')
      AND col_description(class.oid, shown.attnum) IS NULL
    ORDER BY class.oid, shown.attnum, origin.priority
  LOOP
    EXECUTE format('COMMENT ON COLUMN loopscope.%I.%I IS %L', missing.relname, missing.attname, missing.words);
  END LOOP;
END $$;
