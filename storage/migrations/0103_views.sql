-- What people read of loops and of the monitor itself. Each view says in its comment what one row is; 0104 has those
-- that work is planned by.

-- Comments in words of today, which a database that is taken over from the former chain has otherwise.
COMMENT ON COLUMN loopscope.data_problem_kind.shown IS
  'Whether data_problem shows it: false for what is information and nobody''s to repair';
COMMENT ON COLUMN loopscope.data_problem_kind.remedy IS 'What to do about it';

CREATE OR REPLACE VIEW loopscope.verdict_kind (code, is_fault, weight, meaning) AS
  SELECT kind.code, kind.is_fault, parameter.value, kind.meaning
  FROM (VALUES
    ('healthy', false, 'Nothing is left to explain'),
    ('valve_stiction', true, 'The valve sticks and jumps'),
    ('valve_deadband', true, 'The valve has play (backlash)'),
    ('valve_saturation', true, 'The valve runs into a limit'),
    ('valve_characteristic', true, 'The valve''s characteristic is bent: wear, corroded seat, wrong trim'),
    ('valve_oversized', true, 'Tiny movements of the valve move the process a lot'),
    ('process_nonlinearity', true, 'The process itself is nonlinear'),
    ('external_disturbance', true, 'Something outside the loop disturbs it'),
    ('process_change', true, 'The process gain changed'),
    ('sensor_fault', true, 'The measurement is frozen, held or coarse'),
    ('tight_tuning', true, 'The controller is tuned too tightly'),
    ('sluggish_tuning', true, 'The controller is tuned too slowly'),
    ('nonlinear_unexplained', true, 'Nonlinear, but no known effect explains it'),
    ('unexplained', true, 'Structured, but no known effect explains it'),
    ('not_controlling', false, 'No controller acts: manual, tracking, out of service, constant output'),
    ('insufficient_data', false, 'The data cannot be judged')
  ) AS kind (code, is_fault, meaning)
  LEFT JOIN loopscope.parameter ON parameter.name = 'weight_' || kind.code;
COMMENT ON VIEW loopscope.verdict_kind IS 'Every verdict: what it means and how it counts';
COMMENT ON COLUMN loopscope.verdict_kind.code IS 'The verdict; verdict_kind explains every code';
COMMENT ON COLUMN loopscope.verdict_kind.is_fault IS 'Whether it needs action';
COMMENT ON COLUMN loopscope.verdict_kind.weight IS
  'How it counts in the ranking (parameter weight_...); null = no fault';
COMMENT ON COLUMN loopscope.verdict_kind.meaning IS 'What it means, in words';

-- Oscillations that loops share. A round that was stored under a clock ahead holds when its time has come.
CREATE OR REPLACE VIEW loopscope.newest_plant_round AS
  SELECT round.*, round.slot_end + parameter.value * interval '1 day' AS holds_until
  FROM (SELECT * FROM loopscope.plant_round WHERE slot_end <= now()
        ORDER BY slot_end DESC, algorithm_revision DESC LIMIT 1) AS round
  JOIN loopscope.parameter ON parameter.name = 'plant_round_valid_days';
COMMENT ON VIEW loopscope.newest_plant_round IS
  'The comparison across all loops that holds: one row, none before the first one';
COMMENT ON COLUMN loopscope.newest_plant_round.slot_end IS 'Slot of the verdict that was flagged first';
COMMENT ON COLUMN loopscope.newest_plant_round.loops IS 'Loops that were looked at';
COMMENT ON COLUMN loopscope.newest_plant_round.oscillating IS 'Of those, loops that oscillate';
COMMENT ON COLUMN loopscope.newest_plant_round.events IS
  'Oscillations that several of them share: plant_oscillation has one row each, numbered from 1';
COMMENT ON COLUMN loopscope.newest_plant_round.holds_until IS
  'Verdicts of later slots are not hidden by it (parameter plant_round_valid_days)';

-- Without the traces, of which nobody reads the figures.
CREATE OR REPLACE VIEW loopscope.current_plant_oscillation AS
  SELECT oscillation.slot_end, oscillation.algorithm_revision, oscillation.number, oscillation.period_s,
         oscillation.loop_ids, oscillation.strengths, oscillation.lags_s, oscillation.source_loop_id,
         oscillation.statement, oscillation.found_at, oscillation.roles, oscillation.scores, oscillation.p,
         source.name AS source_loop_name, round.holds_until, oscillation.outside, oscillation.reasons, oscillation.leads
  FROM loopscope.newest_plant_round AS round
  JOIN loopscope.plant_oscillation AS oscillation USING (slot_end, algorithm_revision)
  LEFT JOIN loopscope.loop AS source ON source.loop_id = oscillation.source_loop_id
  WHERE oscillation.number <= round.events;
COMMENT ON VIEW loopscope.current_plant_oscillation IS
  'Oscillations that loops share, as the newest round found them: one row each';
COMMENT ON COLUMN loopscope.current_plant_oscillation.slot_end IS 'Slot of the verdict that was flagged first';
COMMENT ON COLUMN loopscope.current_plant_oscillation.period_s IS 'Shared period, seconds';
COMMENT ON COLUMN loopscope.current_plant_oscillation.scores IS
  'How much speaks for each loop as the source, higher = more, in the order of loop_ids; null = not said';
COMMENT ON COLUMN loopscope.current_plant_oscillation.p IS
  'Chance that loops which have nothing to do with each other agree so well; null = not computed';
COMMENT ON COLUMN loopscope.current_plant_oscillation.source_loop_name IS
  'Loop that causes that oscillation; null = outside or unknown';
COMMENT ON COLUMN loopscope.current_plant_oscillation.holds_until IS
  'Verdicts of later slots are not hidden by it (parameter plant_round_valid_days)';
COMMENT ON COLUMN loopscope.current_plant_oscillation.outside IS
  'Probability that none of the loops is the source; null = not said';
COMMENT ON COLUMN loopscope.current_plant_oscillation.reasons IS
  'What speaks for and against each loop as the source, a sentence a line, in the order of loop_ids; null = not said';
COMMENT ON COLUMN loopscope.current_plant_oscillation.leads IS
  'Which loop''s past foretells which one''s future, strongest first: [{from_loop_id, to_loop_id, gain, direct}]; '
  'null = not said';

CREATE OR REPLACE VIEW loopscope.plant_oscillation_member AS
  SELECT oscillation.slot_end, oscillation.algorithm_revision, oscillation.number, oscillation.period_s,
         loop.loop_id, loop.name AS loop_name, member.strength, member.lag_s,
         loop.loop_id IS NOT DISTINCT FROM oscillation.source_loop_id AS is_source, oscillation.statement,
         coalesce(member.role,
                  CASE WHEN loop.loop_id = oscillation.source_loop_id THEN 'source' ELSE 'member' END) AS role,
         member.score,
         EXISTS (SELECT FROM loopscope.newest_plant_round AS newest
                 WHERE (newest.slot_end, newest.algorithm_revision)
                     = (oscillation.slot_end, oscillation.algorithm_revision)) AS is_current,
         member.reasons
  FROM loopscope.plant_oscillation AS oscillation
  LEFT JOIN loopscope.plant_round AS round USING (slot_end, algorithm_revision)
  CROSS JOIN LATERAL unnest(oscillation.loop_ids, oscillation.strengths, oscillation.lags_s, oscillation.roles,
                            oscillation.scores, oscillation.reasons)
    AS member (loop_id, strength, lag_s, role, score, reasons)
  JOIN loopscope.loop ON loop.loop_id = member.loop_id
  -- A round that was written again with fewer events has left the others behind.
  WHERE oscillation.number <= coalesce(round.events, oscillation.number);
COMMENT ON VIEW loopscope.plant_oscillation_member IS 'One row per loop that takes part in a shared oscillation';
COMMENT ON COLUMN loopscope.plant_oscillation_member.strength IS
  'Share of the loop''s error variance at that period, 0 to 1';
COMMENT ON COLUMN loopscope.plant_oscillation_member.lag_s IS 'How much later than the source the loop swings, seconds';
COMMENT ON COLUMN loopscope.plant_oscillation_member.is_source IS 'Whether the loop is the likely source';
COMMENT ON COLUMN loopscope.plant_oscillation_member.role IS
  'What the loop is to it: source, victim, cascade_slave, cascade_master or member (keeps its place on the list)';
COMMENT ON COLUMN loopscope.plant_oscillation_member.score IS
  'Probability of the loop of being the source; of a program before revision 26: how much speaks for it, higher = '
  'more; null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation_member.is_current IS 'Whether it is of the newest round';
COMMENT ON COLUMN loopscope.plant_oscillation_member.reasons IS
  'What speaks for and against the loop as the source, a sentence a line; null = not said';

-- One row a loop, and by a key that the planner knows: who does not ask for it does not pay for it.
CREATE OR REPLACE VIEW loopscope.following_loop AS
  SELECT DISTINCT ON (loop.loop_id) loop.loop_id, loop.name AS loop_name, event.number, event.period_s,
         event.source_loop_name, event.holds_until, coalesce(member.role, 'member') AS role, member.strength,
         round((100 * member.strength)::numeric) || ' % of its error follows the plant-wide oscillation '
           || event.number
           || CASE WHEN event.source_loop_name IS NULL THEN ' of no known source'
                   ELSE ' of ' || event.source_loop_name END
           || ' (period '
           || CASE WHEN event.period_s < 120
                   THEN round(event.period_s::numeric, CASE WHEN event.period_s < 10 THEN 1 ELSE 0 END)::float8 || ' s'
                   WHEN event.period_s < 7200
                   THEN round((event.period_s / 60)::numeric,
                              CASE WHEN event.period_s < 600 THEN 1 ELSE 0 END)::float8 || ' min'
                   ELSE round((event.period_s / 3600)::numeric, 1)::float8 || ' h' END
           || ')' AS follows
  FROM loopscope.current_plant_oscillation AS event
  CROSS JOIN LATERAL unnest(event.loop_ids, event.strengths, event.roles) AS member (loop_id, strength, role)
  JOIN loopscope.loop ON loop.loop_id = member.loop_id
  WHERE member.loop_id IS DISTINCT FROM event.source_loop_id
  ORDER BY loop.loop_id, member.strength DESC, event.number;
COMMENT ON VIEW loopscope.following_loop IS
  'One row per loop that takes part in a shared oscillation of the newest round without being its source: which one, '
  'and how much of its error that is';
COMMENT ON COLUMN loopscope.following_loop.number IS 'Number of the oscillation (current_plant_oscillation)';
COMMENT ON COLUMN loopscope.following_loop.period_s IS 'Shared period, seconds';
COMMENT ON COLUMN loopscope.following_loop.source_loop_name IS 'Loop that causes it; null = outside or unknown';
COMMENT ON COLUMN loopscope.following_loop.holds_until IS 'Nothing is said of verdicts of later slots';
COMMENT ON COLUMN loopscope.following_loop.role IS
  'What the loop is to it: victim, cascade_slave, cascade_master or member';
COMMENT ON COLUMN loopscope.following_loop.strength IS 'Share of the loop''s error variance in the oscillation, 0 to 1';
COMMENT ON COLUMN loopscope.following_loop.follows IS 'All of it in words';

-- The verdict of a loop is what its own window says: list, counts and data problems go by it. What people ask is
-- latest_verdict: a loop that is healthy by itself is not, as they see it, while another one shakes it.
-- schedule.result_slot_end names the slot, so that one partition is probed per loop instead of all.
CREATE OR REPLACE VIEW loopscope.own_verdict AS
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
           '{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,'
           'process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,'
           'nonlinear_unexplained}'::text[],
           verdict.code)]::double precision AS combined_confidence,
         1 - coalesce(analysis.combined_probabilities[1],
                      verdict.cause_probabilities[1])::double precision AS fault_probability,
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
COMMENT ON VIEW loopscope.own_verdict IS
  'One row per loop: the verdict of its newest window by itself, whatever shakes it. List and counts go by it';
COMMENT ON COLUMN loopscope.own_verdict.loop_name IS 'Name of the loop';
COMMENT ON COLUMN loopscope.own_verdict.code IS 'The verdict; verdict_kind explains every code';
COMMENT ON COLUMN loopscope.own_verdict.confidence IS 'Confidence in the verdict, 0 to 1';
COMMENT ON COLUMN loopscope.own_verdict.usable IS 'Whether the data could be judged';
COMMENT ON COLUMN loopscope.own_verdict.coupling IS
  'What the error signal couples: none_found, quadratic, cubic or both';
COMMENT ON COLUMN loopscope.own_verdict.cause_probabilities IS
  'Probability of each cause by the newest window alone (verdict_cause has a row for each)';
COMMENT ON COLUMN loopscope.own_verdict.combined_probabilities IS 'The same by this window and those before it';
COMMENT ON COLUMN loopscope.own_verdict.combined_confidence IS
  'Probability of the code by this window and those before it; null = the code is no cause, or was judged by a '
  'program before schema 22';
COMMENT ON COLUMN loopscope.own_verdict.fault_probability IS
  '1 less the probability of healthy, by all windows where they were combined; null = nothing was weighed';
COMMENT ON COLUMN loopscope.own_verdict.windows_together IS
  'As many windows that share no sample as are remembered behind combined_probabilities; null = they were not combined';
COMMENT ON COLUMN loopscope.own_verdict.follows_oscillation IS
  'Shared oscillation (current_plant_oscillation) that the loop follows without being its source; null = none';
COMMENT ON COLUMN loopscope.own_verdict.follows IS
  'The same in words: how much of its error, whose oscillation, which period';
COMMENT ON COLUMN loopscope.own_verdict.shown_code IS
  'What people are shown (latest_verdict.code): the code, but external_disturbance for a healthy loop of whose error '
  'a fifth or more follows a shared oscillation';

-- 0.95: of those who join an oscillation one in twenty may be there by chance (core/plant, member_rate).
CREATE OR REPLACE VIEW loopscope.latest_verdict AS
  SELECT own.loop_id, own.loop_name, own.source, own.loop_type, own.importance, own.enabled,
         own.slot_end, own.algorithm_revision, own.input_revision, own.analysis_id,
         own.shown_code AS code, CASE WHEN shaken.here THEN 0.95 ELSE own.confidence END AS confidence,
         CASE WHEN NOT shaken.here THEN own.p END AS p,
         CASE WHEN shaken.here THEN 'Another loop or something outside shakes it: ' || own.follows
              ELSE own.summary END AS summary,
         CASE WHEN shaken.here THEN array_prepend(own.follows, own.reasons) ELSE own.reasons END AS reasons,
         CASE WHEN shaken.here
              THEN 'Leave this loop alone; look after the source of plant-wide oscillation '
                   || own.follows_oscillation || ' first'
              ELSE own.action END AS action,
         own.decided_at, own.window_start, own.window_end, own.usable, own.flags,
         own.ngi, own.nli, own.nonlinear_p, own.coupling, own.oscillating, own.oscillation_period_s, own.oscillation_p,
         own.harris_low, own.harris_high, own.harris_p, own.error_std, own.model_excited,
         own.cause_probabilities, own.combined_probabilities,
         CASE WHEN NOT shaken.here THEN own.combined_confidence END AS combined_confidence, own.fault_probability,
         own.area, own.unit, own.description, own.pv_unit, own.owner,
         own.control_fraction, own.control_lost_by, own.control_lost_at, own.windows_together,
         own.follows_oscillation, own.follows, own.code AS own_code
  FROM loopscope.own_verdict AS own
  CROSS JOIN LATERAL (SELECT own.shown_code <> own.code AS here) AS shaken;
COMMENT ON VIEW loopscope.latest_verdict IS
  'One row per loop: its newest verdict as people are shown it. A loop that is healthy by itself (own_code) and '
  'follows a shared oscillation says so';
COMMENT ON COLUMN loopscope.latest_verdict.code IS
  'The verdict; external_disturbance for a loop that is healthy by itself and of whose error a fifth or more follows '
  'a shared oscillation';
COMMENT ON COLUMN loopscope.latest_verdict.fault_probability IS
  'Probability that the loop itself has a fault, by all its windows together';
COMMENT ON COLUMN loopscope.latest_verdict.own_code IS 'What the newest window says by itself';

CREATE OR REPLACE VIEW loopscope.loop_history AS
  SELECT loop.loop_id, loop.name AS loop_name,
         verdict.slot_end, verdict.algorithm_revision, verdict.input_revision,
         verdict.input_revision = analysis.input_revision AS is_current,
         verdict.code, verdict.confidence, verdict.summary, verdict.action, verdict.decided_at,
         analysis.analysis_id, analysis.usable, analysis.ngi, analysis.nli, analysis.nonlinear_p,
         analysis.oscillating, analysis.oscillation_period_s,
         analysis.harris_low, analysis.harris_high, analysis.error_std,
         analysis.valve_travel_per_h, analysis.reversals_per_h,
         ARRAY(SELECT taken.effect FROM loopscope.explanation_step AS taken
               WHERE taken.loop_id = verdict.loop_id AND taken.slot_end = verdict.slot_end
                 AND taken.algorithm_revision = verdict.algorithm_revision
                 AND taken.input_revision = verdict.input_revision
               ORDER BY taken.step) AS effects
  FROM loopscope.loop
  JOIN loopscope.verdict USING (loop_id)
  LEFT JOIN loopscope.analysis
    ON analysis.loop_id = verdict.loop_id AND analysis.slot_end = verdict.slot_end
   AND analysis.algorithm_revision = verdict.algorithm_revision
   AND analysis.input_revision = verdict.input_revision;
COMMENT ON VIEW loopscope.loop_history IS
  'Every verdict that was ever given, with the figures behind it while they are the current ones; ask for one loop_id '
  'and a span of slot_end';
COMMENT ON COLUMN loopscope.loop_history.is_current IS
  'True for the newest input revision; null = replaced when late data arrived';
COMMENT ON COLUMN loopscope.loop_history.code IS 'The verdict; verdict_kind explains every code';
COMMENT ON COLUMN loopscope.loop_history.effects IS
  'What the loop model took in, in that order; explanation_step has the figures';

CREATE OR REPLACE VIEW loopscope.explanation AS
  SELECT latest.loop_id, latest.loop_name, latest.slot_end, latest.algorithm_revision, latest.input_revision,
         latest.code, taken.step, taken.effect, taken.parameters, taken.intervals,
         taken.holdout_error_before, taken.holdout_error_after,
         taken.holdout_error_after / nullif(taken.holdout_error_before, 0) AS error_ratio,
         taken.evidence, taken.p, taken.margin, taken.simulation_ratio, taken.steadiness, taken.statement,
         taken.asked_by
  FROM loopscope.own_verdict AS latest
  JOIN loopscope.explanation_step AS taken USING (loop_id, slot_end, algorithm_revision, input_revision);
COMMENT ON VIEW loopscope.explanation IS
  'One row per effect that the loop model took in, of the newest analysis of each loop: ask for one loop, ORDER BY '
  'step';
COMMENT ON COLUMN loopscope.explanation.code IS 'The verdict that follows from the whole analysis';
COMMENT ON COLUMN loopscope.explanation.error_ratio IS
  'Error on held-out samples after the step over that before it: below 1 = the effect explains something';
COMMENT ON COLUMN loopscope.explanation.asked_by IS
  'Residual tests that asked for the effect, most significant first: [{test, p, p_after, statement}]; [] = none '
  'asked, a first look showed it; null = of a program before schema 20';

-- How probable every cause is, beside the one that the verdict names.
CREATE OR REPLACE VIEW loopscope.verdict_cause AS
  SELECT loop.loop_id, loop.name AS loop_name, given.slot_end, given.algorithm_revision, given.input_revision,
         given.code, weighed.cause, weighed.probability
  FROM loopscope.loop
  JOIN loopscope.verdict AS given USING (loop_id)
  CROSS JOIN LATERAL unnest(
    '{healthy,valve_stiction,valve_deadband,valve_saturation,valve_characteristic,valve_oversized,'
    'process_nonlinearity,external_disturbance,process_change,sensor_fault,tight_tuning,sluggish_tuning,'
    'nonlinear_unexplained}'::text[],
    given.cause_probabilities) AS weighed (cause, probability)
  WHERE weighed.probability IS NOT NULL;
COMMENT ON VIEW loopscope.verdict_cause IS
  'One row per verdict and cause: how probable the cause is; ask for one loop or slot. Verdicts of programs before '
  'schema 21 have none';
COMMENT ON COLUMN loopscope.verdict_cause.loop_id IS 'The loop';
COMMENT ON COLUMN loopscope.verdict_cause.slot_end IS 'End of the slot';
COMMENT ON COLUMN loopscope.verdict_cause.algorithm_revision IS 'Revision of the diagnosis';
COMMENT ON COLUMN loopscope.verdict_cause.input_revision IS 'Revision of the input; the highest is the newest';
COMMENT ON COLUMN loopscope.verdict_cause.code IS 'The verdict that was given';
COMMENT ON COLUMN loopscope.verdict_cause.cause IS
  'A cause of the catalogue (verdict_kind); nonlinear_unexplained = any nonlinearity of valve or process';
COMMENT ON COLUMN loopscope.verdict_cause.probability IS
  'Probability that the cause is there, 0 to 1; causes may stand together';

-- Rows that arrive late change what a slot's window holds. What changed, and when, in one place.
CREATE OR REPLACE VIEW loopscope.revised_verdict AS
  SELECT loop.loop_id, loop.name AS loop_name, revised.slot_end, revised.algorithm_revision,
         revised.input_revision, revised.decided_at AS revised_at, former.decided_at AS former_decided_at,
         former.code AS former_code, revised.code, former.code <> revised.code AS code_changed,
         former.confidence AS former_confidence, revised.confidence,
         former.summary AS former_summary, revised.summary, revised.analysis_id
  FROM loopscope.verdict AS revised
  JOIN loopscope.loop USING (loop_id)
  LEFT JOIN loopscope.verdict AS former
    ON former.loop_id = revised.loop_id AND former.slot_end = revised.slot_end
   AND former.algorithm_revision = revised.algorithm_revision
   AND former.input_revision = revised.input_revision - 1
  WHERE revised.input_revision > 1;
COMMENT ON VIEW loopscope.revised_verdict IS
  'One row per revision of a stored analysis, whose input had changed (late rows, other settings, other tags): the '
  'verdict beside the former one';
COMMENT ON COLUMN loopscope.revised_verdict.input_revision IS '2 = the first revision of the slot';
COMMENT ON COLUMN loopscope.revised_verdict.revised_at IS 'When the slot was analysed again';
COMMENT ON COLUMN loopscope.revised_verdict.former_decided_at IS 'When the former verdict was given';
COMMENT ON COLUMN loopscope.revised_verdict.former_code IS 'The verdict before the revision';
COMMENT ON COLUMN loopscope.revised_verdict.code IS 'The verdict; verdict_kind explains every code';
COMMENT ON COLUMN loopscope.revised_verdict.code_changed IS 'Whether the revision gave another verdict';
COMMENT ON COLUMN loopscope.revised_verdict.former_confidence IS 'Confidence of the former verdict';
COMMENT ON COLUMN loopscope.revised_verdict.former_summary IS 'Summary of the former verdict';

CREATE OR REPLACE VIEW loopscope.data_quality AS
  SELECT latest.loop_id, latest.loop_name, latest.source, latest.enabled, latest.slot_end,
         analysis.usable, analysis.unusable_reason, analysis.flags, analysis.samples, analysis.interval_s,
         analysis.missing_fraction, analysis.compression_factor, analysis.quantisation_factor,
         analysis.saturated_fraction, analysis.auto_fraction, analysis.segments
  FROM loopscope.own_verdict AS latest
  CROSS JOIN LATERAL (
    SELECT * FROM loopscope.analysis AS measured
    WHERE measured.loop_id = latest.loop_id AND measured.slot_end = latest.slot_end
      AND measured.algorithm_revision = latest.algorithm_revision
    LIMIT 1) AS analysis;
COMMENT ON VIEW loopscope.data_quality IS 'One row per analysed loop: what its newest data are worth';

-- What plants look at first: whether their controllers are in service at all.
CREATE OR REPLACE VIEW loopscope.service_factor AS
  SELECT latest.loop_id, latest.loop_name, latest.area, latest.unit, latest.description, latest.owner, latest.source,
         latest.loop_type, latest.importance,
         latest.code <> 'not_controlling' AS controlling, latest.control_fraction, week.fraction AS week_fraction,
         CASE WHEN latest.control_lost_at IS NOT NULL THEN latest.control_lost_by END AS lost_by,
         CASE WHEN latest.control_lost_at IS NOT NULL
              THEN coalesce(lost.since, latest.control_lost_at) END AS lost_since,
         latest.slot_end
  FROM loopscope.own_verdict AS latest
  CROSS JOIN LATERAL (
    SELECT avg(past.control_fraction) AS fraction FROM loopscope.analysis AS past
    WHERE past.loop_id = latest.loop_id AND past.slot_end > latest.slot_end - interval '7 days'
      AND past.slot_end <= latest.slot_end) AS week
  -- The newest window that shows its beginning, or the first behind the last one at whose end a controller acted.
  CROSS JOIN LATERAL (
    SELECT coalesce(max(past.control_lost_at) FILTER (WHERE past.control_lost_at > past.window_start),
                    min(past.control_lost_at)) AS since
    FROM loopscope.analysis AS past
    WHERE latest.control_lost_at IS NOT NULL AND past.loop_id = latest.loop_id AND past.slot_end <= latest.slot_end
      AND past.slot_end > latest.slot_end - interval '90 days' AND past.control_lost_at IS NOT NULL
      AND past.slot_end > coalesce((
        SELECT max(acting.slot_end) FROM loopscope.analysis AS acting
        WHERE acting.loop_id = latest.loop_id AND acting.slot_end < latest.slot_end
          AND acting.slot_end > latest.slot_end - interval '90 days'
          AND acting.control_fraction IS NOT NULL AND acting.control_lost_at IS NULL), '-infinity')) AS lost
  WHERE latest.enabled AND (latest.control_fraction IS NOT NULL OR latest.code = 'not_controlling');
COMMENT ON VIEW loopscope.service_factor IS
  'One row per enabled loop whose mode or output is recorded: whether a controller acts on it, for which share of the '
  'time, since when not. The mean of week_fraction over an area is its service factor';
COMMENT ON COLUMN loopscope.service_factor.controlling IS
  'false: for most of the newest window no controller acted (verdict not_controlling)';
COMMENT ON COLUMN loopscope.service_factor.week_fraction IS 'Mean share over the windows of the last seven days';
COMMENT ON COLUMN loopscope.service_factor.lost_by IS
  'Where none acts at the window''s end, what says so: mode or constant_output; null = one acts';
COMMENT ON COLUMN loopscope.service_factor.lost_since IS
  'Since when, as far as the last 90 days of windows show; null = one acts';

CREATE OR REPLACE VIEW loopscope.data_problem AS
  SELECT latest.loop_id, latest.loop_name, latest.source, problem.role,
         CASE problem.role WHEN 'sp' THEN loop.sp_tag WHEN 'pv' THEN loop.pv_tag WHEN 'op' THEN loop.op_tag
                           WHEN 'mv' THEN loop.mv_tag WHEN 'mode' THEN loop.mode_tag END AS tag,
         problem.code AS problem, problem.words, problem.remedy,
         latest.code NOT IN ('insufficient_data', 'not_controlling') AS judged,
         problem.since, problem.slots, problem.last_row, problem.figure, latest.slot_end,
         latest.area, latest.unit, latest.owner
  FROM loopscope.own_verdict AS latest
  JOIN loopscope.loop USING (loop_id)
  JOIN loopscope.schedule USING (loop_id)
  CROSS JOIN LATERAL (
    -- What the analysis itself says ...
    SELECT said.code,
           CASE WHEN said.code = 'not_controlling' AND latest.control_lost_by = 'constant_output' THEN 'op'
                ELSE kind.role END AS role,
           CASE said.code
             WHEN 'insufficient_data' THEN kind.words || ': ' || measured.unusable_reason
             WHEN 'op_range_doubted' THEN kind.words || ': ' || measured.op_range_doubt
             WHEN 'not_controlling' THEN
               CASE latest.control_lost_by WHEN 'mode' THEN 'In manual, tracking or out of service'
                    ELSE 'The output is constant: in manual or out of service?' END
               || coalesce(', since ' || to_char(service.lost_since AT TIME ZONE 'UTC', 'YYYY-MM-DD HH24:MI "UTC"'), '')
             ELSE coalesce(kind.words, replace(said.code, '_', ' ')) END AS words,
           -- A young loop is short of nothing but time.
           CASE WHEN said.code = 'insufficient_data' AND measured.samples < wanted.samples AND measured.interval_s > 0
                     AND coalesce(measured.missing_fraction, 0) < 0.1
                THEN 'Wait: ' || wanted.samples || ' samples will be there at '
                     || to_char((measured.window_end + (wanted.samples - measured.samples) * measured.interval_s
                                                       * interval '1 second') AT TIME ZONE 'UTC',
                                'YYYY-MM-DD HH24:MI "UTC"')
                ELSE coalesce(kind.remedy, '') END AS remedy,
           CASE WHEN said.code = 'not_controlling'
                THEN coalesce(service.lost_since, standing.first_slot, latest.slot_end)
                ELSE coalesce(standing.first_slot, latest.slot_end) END AS since, coalesce(standing.slots, 1) AS slots,
           standing.last_row, standing.figure
    FROM (SELECT usable, unusable_reason, flags, samples, interval_s, missing_fraction, window_end, op_range_doubt,
                 settings
          FROM loopscope.analysis
          WHERE analysis.loop_id = latest.loop_id AND analysis.slot_end = latest.slot_end
            AND analysis.algorithm_revision = latest.algorithm_revision LIMIT 1) AS measured
    CROSS JOIN LATERAL (
      SELECT coalesce((measured.settings #>> '{analysis,min_usable_samples}')::bigint, 512) AS samples) AS wanted
    CROSS JOIN LATERAL (
      SELECT flag AS code FROM unnest(measured.flags) AS flag
      UNION ALL SELECT latest.code WHERE latest.code IN ('insufficient_data', 'not_controlling')) AS said
    LEFT JOIN LATERAL (
      SELECT lost_since FROM loopscope.service_factor AS factor
      WHERE said.code = 'not_controlling' AND factor.loop_id = latest.loop_id) AS service ON true
    LEFT JOIN loopscope.data_problem_kind AS kind ON kind.code = said.code
    LEFT JOIN loopscope.standing_problem AS standing
      ON standing.loop_id = latest.loop_id AND standing.code = said.code AND standing.role = ''
     AND standing.last_slot = latest.slot_end
    WHERE coalesce(kind.shown, true)
    UNION ALL
    -- ... and what the monitor saw on the tags.
    SELECT standing.code, standing.role, coalesce(kind.words, replace(standing.code, '_', ' ')),
           coalesce(kind.remedy, ''), coalesce(standing.last_row, standing.first_slot), standing.slots,
           standing.last_row, standing.figure
    FROM loopscope.standing_problem AS standing
    LEFT JOIN loopscope.data_problem_kind AS kind ON kind.code = standing.code
    WHERE standing.loop_id = latest.loop_id AND standing.role <> '' AND standing.last_slot = schedule.last_slot_end
      AND coalesce(kind.shown, true)
  ) AS problem
  WHERE latest.enabled;
COMMENT ON VIEW loopscope.data_problem IS
  'One row per problem of an enabled loop''s newest data: the tag to repair, what is wrong, since when';
COMMENT ON COLUMN loopscope.data_problem.role IS 'sp, pv, op, mv or mode; null = not said';
COMMENT ON COLUMN loopscope.data_problem.tag IS 'The tag to repair; null = the catalogue names none';
COMMENT ON COLUMN loopscope.data_problem.problem IS 'Flag of the analysis, or code of data_problem_kind';
COMMENT ON COLUMN loopscope.data_problem.words IS 'What is wrong, in words';
COMMENT ON COLUMN loopscope.data_problem.remedy IS 'What to do about it; empty = not known';
COMMENT ON COLUMN loopscope.data_problem.judged IS 'Whether the loop could be judged all the same';
COMMENT ON COLUMN loopscope.data_problem.since IS
  'Time of the tag''s newest row where that is what is wrong, else the first slot of the unbroken row';

CREATE OR REPLACE VIEW loopscope.monitor_health AS
  WITH health AS (
    SELECT loop.loop_id, loop.name AS loop_name, loop.source, loop.enabled, loop.period_s,
           schedule.last_slot_end,
           extract(epoch FROM now() - schedule.last_slot_end)::double precision AS age_s,
           schedule.attempts AS failures, schedule.last_error,
           CASE WHEN loop.enabled
                THEN greatest(extract(epoch FROM now() - schedule.visible_at), 0)::double precision END AS overdue_s,
           schedule.owner, schedule.owner IS NOT NULL AND schedule.visible_at > now() AS leased,
           loop.enabled AND schedule.last_slot_end IS NULL AS never_analysed,
           latest.code = 'insufficient_data' AS dead_data,
           dead.tags AS dead_tags, dead.roles AS dead_roles, dead.since AS dead_since
    FROM loopscope.loop
    JOIN loopscope.schedule USING (loop_id)
    LEFT JOIN loopscope.own_verdict AS latest USING (loop_id)
    LEFT JOIN LATERAL (
      SELECT array_agg(stopped.tag ORDER BY stopped.role) AS tags,
             array_agg(stopped.role ORDER BY stopped.role) AS roles,
             array_agg(stopped.since ORDER BY stopped.role) AS since
      FROM (SELECT standing.role, coalesce(standing.last_row, standing.first_slot) AS since,
                   CASE standing.role WHEN 'sp' THEN loop.sp_tag WHEN 'pv' THEN loop.pv_tag WHEN 'op' THEN loop.op_tag
                                      WHEN 'mv' THEN loop.mv_tag WHEN 'mode' THEN loop.mode_tag END AS tag
            FROM loopscope.standing_problem AS standing
            WHERE standing.loop_id = loop.loop_id AND standing.code IN ('dead_tag', 'no_rows')
              AND standing.last_slot = schedule.last_slot_end) AS stopped
    ) AS dead ON true
  )
  SELECT CASE WHEN NOT enabled THEN 'disabled'
              WHEN failures > 0 THEN 'failing'
              WHEN overdue_s > period_s THEN 'overdue'
              WHEN never_analysed THEN 'never_analysed'
              WHEN dead_data THEN 'dead_data'
              WHEN dead_tags IS NOT NULL THEN 'dead_tag'
              ELSE 'ok' END AS state,
         health.*
  FROM health;
COMMENT ON VIEW loopscope.monitor_health IS 'One row per loop: whether the monitor itself does its work there';
COMMENT ON COLUMN loopscope.monitor_health.state IS
  'disabled, failing, overdue (by more than a period), never_analysed, dead_data (cannot be judged), dead_tag '
  '(judged, but a tag has stopped) or ok: the first that applies';
COMMENT ON COLUMN loopscope.monitor_health.age_s IS
  'Seconds since the end of the newest completed slot; null = never analysed';
COMMENT ON COLUMN loopscope.monitor_health.failures IS 'Failures in a row, lost leases included';
COMMENT ON COLUMN loopscope.monitor_health.overdue_s IS
  'Seconds since the loop was due or its lease ended; null = disabled';
COMMENT ON COLUMN loopscope.monitor_health.owner IS 'Worker that holds the loop; null = nobody';
COMMENT ON COLUMN loopscope.monitor_health.leased IS 'Whether a worker holds it now';
COMMENT ON COLUMN loopscope.monitor_health.never_analysed IS 'Enabled, but no slot was completed yet';
COMMENT ON COLUMN loopscope.monitor_health.dead_data IS
  'Whether the newest data could not be judged; null = never analysed';
COMMENT ON COLUMN loopscope.monitor_health.dead_tags IS 'Tags that have stopped or have no row at all; null = none';
COMMENT ON COLUMN loopscope.monitor_health.dead_roles IS 'What each of them is: sp, pv, op, mv or mode';
COMMENT ON COLUMN loopscope.monitor_health.dead_since IS
  'Time of the newest row of each; where there is none, the slot that missed it first';

CREATE OR REPLACE VIEW loopscope.stage_breakdown AS
  SELECT hour, host, count(*) AS lanes, sum(loops)::bigint AS loops, sum(analysed)::bigint AS analysed,
         sum(modelled)::bigint AS modelled,
         1000 * sum(claim_s) / nullif(sum(loops), 0) AS claim_ms,
         1000 * sum(fetch_s) / nullif(sum(loops), 0) AS fetch_ms,
         1000 * sum(prepare_s) / nullif(sum(loops), 0) AS prepare_ms,
         1000 * sum(statistics_s) / nullif(sum(loops), 0) AS statistics_ms,
         1000 * sum(model_s) / nullif(sum(loops), 0) AS model_ms,
         1000 * sum(decide_s) / nullif(sum(loops), 0) AS decide_ms,
         1000 * sum(write_s) / nullif(sum(loops), 0) AS write_ms,
         1000 * sum(wait_s) / nullif(sum(loops), 0) AS wait_ms,
         1000 * sum(model_s) / nullif(sum(modelled), 0) AS ms_per_model
  FROM loopscope.stage_cost GROUP BY hour, host;
COMMENT ON VIEW loopscope.stage_breakdown IS 'Milliseconds a loop in each stage, per hour and host';
COMMENT ON COLUMN loopscope.stage_breakdown.lanes IS 'Lanes that worked in this hour';
COMMENT ON COLUMN loopscope.stage_breakdown.claim_ms IS 'Milliseconds a loop for taking it from the schedule';
COMMENT ON COLUMN loopscope.stage_breakdown.fetch_ms IS
  'Milliseconds a loop for its rows out of the historian, waiting for a connection included';
COMMENT ON COLUMN loopscope.stage_breakdown.prepare_ms IS
  'Milliseconds a loop for masks, gaps, archive and oscillation';
COMMENT ON COLUMN loopscope.stage_breakdown.statistics_ms IS
  'Milliseconds a loop for the higher-order statistics, shapes and performance';
COMMENT ON COLUMN loopscope.stage_breakdown.model_ms IS 'Milliseconds a loop for the loop model, spread over all loops';
COMMENT ON COLUMN loopscope.stage_breakdown.decide_ms IS 'Milliseconds a loop for verdict, digest and JSON';
COMMENT ON COLUMN loopscope.stage_breakdown.write_ms IS 'Milliseconds a loop for its rows into the results';
COMMENT ON COLUMN loopscope.stage_breakdown.wait_ms IS
  'Milliseconds a loop of waiting for a core that is free to analyse';
COMMENT ON COLUMN loopscope.stage_breakdown.ms_per_model IS 'Milliseconds for one loop model; null = none was fitted';
