-- What a reader is shown of an oscillation that loops share: the odds and what speaks for and against each loop as its source,
-- who foretells whom, trends and spectra. Programs of before, which may still be at work, leave all of it null.
ALTER TABLE loopscope.plant_oscillation
  ADD COLUMN outside double precision CHECK (outside BETWEEN 0 AND 1), ADD COLUMN reasons text[], ADD COLUMN leads jsonb, ADD COLUMN traces jsonb,
  ADD CONSTRAINT plant_oscillation_reasons CHECK (reasons IS NULL OR cardinality(reasons) = cardinality(loop_ids)),
  ADD CONSTRAINT plant_oscillation_lists CHECK (jsonb_typeof(leads) = 'array' AND jsonb_typeof(traces) = 'array');
COMMENT ON COLUMN loopscope.plant_oscillation.outside IS 'Probability that none of the loops is the source: it lies outside of what is recorded; null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation.scores IS 'Probability of each loop of being the source, in the order of loop_ids; of a program before revision 26: how much speaks for it, higher = more; null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation.reasons IS 'What speaks for and against each loop as the source, a sentence a line, in the order of loop_ids; null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation.leads IS 'Which loop''s past foretells which one''s future, strongest first: [{from_loop_id, to_loop_id, gain, direct}], gain = ln(error before / after) of the forecast, direct = the same of what no other member tells as well; null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation.traces IS 'What is drawn of the loops that it shakes most: [{loop_id, start_us, step_s, error, periods_s, power}], means of sp - pv over the last twelve periods from start_us (microseconds since 1970) on, and the spectrum of the whole window as share of the variance per unit of ln(period); null = not kept';

-- Without the traces, of which nobody reads the figures.
CREATE OR REPLACE VIEW loopscope.current_plant_oscillation AS
  SELECT oscillation.slot_end, oscillation.algorithm_revision, oscillation.number, oscillation.period_s, oscillation.loop_ids, oscillation.strengths,
         oscillation.lags_s, oscillation.source_loop_id, oscillation.statement, oscillation.found_at, oscillation.roles, oscillation.scores, oscillation.p,
         source.name AS source_loop_name, round.holds_until, oscillation.outside, oscillation.reasons, oscillation.leads
  FROM loopscope.newest_plant_round AS round
  JOIN loopscope.plant_oscillation AS oscillation USING (slot_end, algorithm_revision)
  LEFT JOIN loopscope.loop AS source ON source.loop_id = oscillation.source_loop_id
  WHERE oscillation.number <= round.events;
COMMENT ON COLUMN loopscope.current_plant_oscillation.outside IS 'Probability that none of the loops is the source; null = not said';
COMMENT ON COLUMN loopscope.current_plant_oscillation.reasons IS 'What speaks for and against each loop as the source, a sentence a line, in the order of loop_ids; null = not said';
COMMENT ON COLUMN loopscope.current_plant_oscillation.leads IS 'Which loop''s past foretells which one''s future, strongest first: [{from_loop_id, to_loop_id, gain, direct}]; null = not said';

CREATE OR REPLACE VIEW loopscope.plant_oscillation_member AS
  SELECT oscillation.slot_end, oscillation.algorithm_revision, oscillation.number, oscillation.period_s,
         loop.loop_id, loop.name AS loop_name, member.strength, member.lag_s,
         loop.loop_id IS NOT DISTINCT FROM oscillation.source_loop_id AS is_source, oscillation.statement,
         coalesce(member.role, CASE WHEN loop.loop_id = oscillation.source_loop_id THEN 'source' ELSE 'member' END) AS role,
         member.score, EXISTS (SELECT FROM loopscope.newest_plant_round AS newest WHERE (newest.slot_end, newest.algorithm_revision)
                                 = (oscillation.slot_end, oscillation.algorithm_revision)) AS is_current,
         member.reasons
  FROM loopscope.plant_oscillation AS oscillation
  LEFT JOIN loopscope.plant_round AS round USING (slot_end, algorithm_revision)
  CROSS JOIN LATERAL unnest(oscillation.loop_ids, oscillation.strengths, oscillation.lags_s, oscillation.roles, oscillation.scores, oscillation.reasons)
    AS member (loop_id, strength, lag_s, role, score, reasons)
  JOIN loopscope.loop ON loop.loop_id = member.loop_id
  -- A round that was written again with fewer events has left the others behind.
  WHERE oscillation.number <= coalesce(round.events, oscillation.number);
COMMENT ON COLUMN loopscope.plant_oscillation_member.score IS 'Probability of the loop of being the source; of a program before revision 26: how much speaks for it, higher = more; null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation_member.reasons IS 'What speaks for and against the loop as the source, a sentence a line; null = not said';

-- One row a loop, and by a key that the planner knows: who does not ask for it does not pay for it.
CREATE VIEW loopscope.following_loop AS
  SELECT DISTINCT ON (loop.loop_id) loop.loop_id, loop.name AS loop_name, event.number, event.period_s, event.source_loop_name, event.holds_until,
         coalesce(member.role, 'member') AS role, member.strength,
         round((100 * member.strength)::numeric) || ' % of its error follows the plant-wide oscillation ' || event.number
           || CASE WHEN event.source_loop_name IS NULL THEN ' of no known source' ELSE ' of ' || event.source_loop_name END || ' (period '
           || CASE WHEN event.period_s < 120 THEN round(event.period_s::numeric, CASE WHEN event.period_s < 10 THEN 1 ELSE 0 END)::float8 || ' s'
                   WHEN event.period_s < 7200 THEN round((event.period_s / 60)::numeric, CASE WHEN event.period_s < 600 THEN 1 ELSE 0 END)::float8 || ' min'
                   ELSE round((event.period_s / 3600)::numeric, 1)::float8 || ' h' END || ')' AS follows
  FROM loopscope.current_plant_oscillation AS event
  CROSS JOIN LATERAL unnest(event.loop_ids, event.strengths, event.roles) AS member (loop_id, strength, role)
  JOIN loopscope.loop ON loop.loop_id = member.loop_id
  WHERE member.loop_id IS DISTINCT FROM event.source_loop_id
  ORDER BY loop.loop_id, member.strength DESC, event.number;
COMMENT ON VIEW loopscope.following_loop IS 'One row per loop that takes part in a shared oscillation of the newest round without being its source: which one, and how much of its error that is';
COMMENT ON COLUMN loopscope.following_loop.loop_id IS 'Number of the loop'; COMMENT ON COLUMN loopscope.following_loop.loop_name IS 'Name of the loop';
COMMENT ON COLUMN loopscope.following_loop.number IS 'Number of the oscillation (current_plant_oscillation)';
COMMENT ON COLUMN loopscope.following_loop.period_s IS 'Shared period, seconds';
COMMENT ON COLUMN loopscope.following_loop.source_loop_name IS 'Loop that causes it; null = outside or unknown';
COMMENT ON COLUMN loopscope.following_loop.holds_until IS 'Nothing is said of verdicts of later slots';
COMMENT ON COLUMN loopscope.following_loop.role IS 'What the loop is to it: victim, cascade_slave, cascade_master or member';
COMMENT ON COLUMN loopscope.following_loop.strength IS 'Share of the loop''s error variance in the oscillation, 0 to 1';
COMMENT ON COLUMN loopscope.following_loop.follows IS 'All of it in words';

-- The verdict of a loop stays what its own window says: list, counts and data problems go on by it, under another name. What
-- people ask is latest_verdict: a loop that is healthy by itself is not, as they see it, while another one shakes it.
CREATE OR REPLACE VIEW loopscope.latest_verdict AS
  SELECT loop.loop_id, loop.name AS loop_name, loop.source, loop.loop_type, loop.importance, loop.enabled,
         verdict.slot_end, verdict.algorithm_revision, verdict.input_revision, verdict.analysis_id,
         verdict.code, verdict.confidence, verdict.p,
         verdict.summary, verdict.reasons, verdict.action, verdict.decided_at,
         analysis.window_start, analysis.window_end, analysis.usable, analysis.flags,
         analysis.ngi, analysis.nli, analysis.nonlinear_p, analysis.coupling,
         analysis.oscillating, analysis.oscillation_period_s, analysis.oscillation_p,
         analysis.harris_low, analysis.harris_high, analysis.harris_p, analysis.error_std,
         analysis.model_excited,
         verdict.cause_probabilities, analysis.combined_probabilities,
         analysis.combined_probabilities[array_position(
           '{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,nonlinear_unexplained}'::text[],
           verdict.code)]::double precision AS combined_confidence,
         1 - coalesce(analysis.combined_probabilities[1], verdict.cause_probabilities[1])::double precision AS fault_probability,
         loop.area, loop.unit, loop.description, loop.pv_unit, loop.owner,
         analysis.control_fraction, analysis.control_lost_by, analysis.control_lost_at,
         (SELECT max(windows) FROM unnest(analysis.combined_windows) AS windows)::double precision AS windows_together,
         CASE WHEN verdict.slot_end <= followed.holds_until THEN followed.number END AS follows_oscillation,
         CASE WHEN verdict.slot_end <= followed.holds_until THEN followed.follows END AS follows,
         CASE WHEN verdict.code = 'healthy' AND verdict.slot_end <= followed.holds_until AND followed.strength >= 0.2
              THEN 'external_disturbance' ELSE verdict.code END AS shown_code
  FROM loopscope.loop
  JOIN loopscope.schedule USING (loop_id)
  CROSS JOIN LATERAL (
    SELECT * FROM loopscope.verdict AS candidate
    WHERE candidate.loop_id = schedule.loop_id AND candidate.slot_end = schedule.result_slot_end
    ORDER BY candidate.algorithm_revision DESC, candidate.input_revision DESC
    LIMIT 1) AS verdict
  CROSS JOIN LATERAL (
    SELECT * FROM loopscope.analysis AS measured
    WHERE measured.loop_id = verdict.loop_id AND measured.slot_end = verdict.slot_end
      AND measured.algorithm_revision = verdict.algorithm_revision
    LIMIT 1) AS analysis
  LEFT JOIN loopscope.following_loop AS followed ON followed.loop_id = loop.loop_id;
ALTER VIEW loopscope.latest_verdict RENAME TO own_verdict;
COMMENT ON VIEW loopscope.own_verdict IS 'One row per loop: the verdict of its newest window by itself, whatever shakes it. List and counts go by it';
COMMENT ON COLUMN loopscope.own_verdict.follows_oscillation IS 'Shared oscillation (current_plant_oscillation) that the loop follows without being its source; null = none';
COMMENT ON COLUMN loopscope.own_verdict.follows IS 'The same in words: how much of its error, whose oscillation, which period';
COMMENT ON COLUMN loopscope.own_verdict.shown_code IS 'What people are shown (latest_verdict.code): the code, but external_disturbance for a healthy loop of whose error a fifth or more follows a shared oscillation';

-- 0.95: of those who join an oscillation one in twenty may be there by chance (core/plant, member_rate).
CREATE VIEW loopscope.latest_verdict AS
  SELECT own.loop_id, own.loop_name, own.source, own.loop_type, own.importance, own.enabled,
         own.slot_end, own.algorithm_revision, own.input_revision, own.analysis_id,
         own.shown_code AS code, CASE WHEN shaken.here THEN 0.95 ELSE own.confidence END AS confidence, CASE WHEN NOT shaken.here THEN own.p END AS p,
         CASE WHEN shaken.here THEN 'Another loop or something outside shakes it: ' || own.follows ELSE own.summary END AS summary,
         CASE WHEN shaken.here THEN array_prepend(own.follows, own.reasons) ELSE own.reasons END AS reasons,
         CASE WHEN shaken.here THEN 'Leave this loop alone; look after the source of plant-wide oscillation ' || own.follows_oscillation || ' first' ELSE own.action END AS action,
         own.decided_at, own.window_start, own.window_end, own.usable, own.flags,
         own.ngi, own.nli, own.nonlinear_p, own.coupling, own.oscillating, own.oscillation_period_s, own.oscillation_p,
         own.harris_low, own.harris_high, own.harris_p, own.error_std, own.model_excited,
         own.cause_probabilities, own.combined_probabilities, CASE WHEN NOT shaken.here THEN own.combined_confidence END AS combined_confidence, own.fault_probability,
         own.area, own.unit, own.description, own.pv_unit, own.owner,
         own.control_fraction, own.control_lost_by, own.control_lost_at, own.windows_together,
         own.follows_oscillation, own.follows, own.code AS own_code
  FROM loopscope.own_verdict AS own
  CROSS JOIN LATERAL (SELECT own.shown_code <> own.code AS here) AS shaken;
COMMENT ON VIEW loopscope.latest_verdict IS 'One row per loop: its newest verdict as people are shown it. A loop that is healthy by itself (own_code) and follows a shared oscillation says so';
COMMENT ON COLUMN loopscope.latest_verdict.code IS 'The verdict; external_disturbance for a loop that is healthy by itself and of whose error a fifth or more follows a shared oscillation';
COMMENT ON COLUMN loopscope.latest_verdict.fault_probability IS 'Probability that the loop itself has a fault, by all its windows together';
COMMENT ON COLUMN loopscope.latest_verdict.own_code IS 'What the newest window says by itself';
DO $$
DECLARE missing record;
BEGIN
  FOR missing IN
    SELECT shown.attname, col_description(source.attrelid, source.attnum) AS words
    FROM pg_attribute AS shown JOIN pg_attribute AS source ON source.attname = shown.attname AND source.attrelid = 'loopscope.own_verdict'::regclass
    WHERE shown.attrelid = 'loopscope.latest_verdict'::regclass AND shown.attnum > 0 AND col_description(shown.attrelid, shown.attnum) IS NULL
  LOOP
    EXECUTE format('COMMENT ON COLUMN loopscope.latest_verdict.%I IS %L', missing.attname, missing.words);
  END LOOP;
  -- Rights of persons stay with the name that they were given on.
  FOR missing IN
    SELECT DISTINCT role.rolname FROM pg_class AS class, aclexplode(class.relacl) AS given JOIN pg_roles AS role ON role.oid = given.grantee
    WHERE class.oid = 'loopscope.own_verdict'::regclass AND given.privilege_type = 'SELECT' AND given.grantee <> class.relowner
  LOOP
    EXECUTE format('GRANT SELECT ON loopscope.latest_verdict TO %I', missing.rolname);
  END LOOP;
END $$;
