-- A plant of nine loops in which every view has something to show: sixty days of verdicts, every
-- twelve hours. For tests of queries; run it once on an empty schema.
\set ON_ERROR_STOP on
BEGIN;
SET LOCAL search_path = loopscope;

INSERT INTO loop (name, source, sp_tag, pv_tag, op_tag, loop_type, period_s, importance, enabled)
SELECT name, 'plant', name || '.SP', name || '.PV', name || '.OP', kind, 43200, 1, name <> 'OFF1'
FROM (VALUES ('FIC101', 'flow'), ('FIC102', 'flow'), ('FIC103', 'flow'), ('PIC200', 'pressure'), ('LIC300', 'level'),
             ('TIC400', 'temperature'), ('NEW1', 'flow'), ('DEAD1', NULL), ('OFF1', NULL)) AS told (name, kind);

-- FIC101 swings FIC102 and became worse a week ago; NEW1 sticks since yesterday; TIC400 was repaired
-- and PIC200 was retuned in vain, both a month ago.
CREATE TEMP TABLE told ON COMMIT DROP AS
SELECT loop_id, name, slot_end, age_days,
       CASE WHEN name IN ('FIC101', 'LIC300') THEN 'valve_stiction'
            WHEN name = 'FIC102' THEN 'external_disturbance'
            WHEN name = 'PIC200' THEN 'tight_tuning'
            WHEN name = 'TIC400' AND age_days > 30 THEN 'valve_deadband'
            WHEN name = 'NEW1' AND age_days < 1 THEN 'valve_stiction'
            WHEN name = 'OFF1' THEN 'valve_stiction'
            WHEN name = 'DEAD1' THEN 'insufficient_data'
            WHEN name = 'FIC103' AND age_days = 0 THEN 'not_controlling'
            ELSE 'healthy' END AS code,
       CASE WHEN name = 'FIC101' AND age_days < 7 THEN 4 ELSE 2 END::float8 AS error_std,
       nextval('loopscope.analysis_id') AS analysis_id
FROM loop, generate_series(0, 119) AS k,
     LATERAL (SELECT k / 2.0 AS age_days, date_trunc('hour', now()) - k * interval '12 h' AS slot_end) AS slot;

INSERT INTO analysis (loop_id, slot_end, algorithm_revision, analysis_id, fence, program_version, settings, input_digest,
                      fetch_ms, analyse_ms, window_start, window_end, samples, interval_s, usable, unusable_reason, flags,
                      ngi, nli, nonlinear_p, oscillating, oscillation_period_s, oscillation_p, harris_low, harris_high,
                      error_std, valve_travel_per_h, reversals_per_h, control_fraction, control_lost_by, control_lost_at)
SELECT loop_id, slot_end, 1, analysis_id, 1, '1', '{}', '', 1, 1, slot_end - interval '4095 s', slot_end, 4096, 1,
       code NOT IN ('insufficient_data', 'not_controlling'), CASE WHEN code = 'insufficient_data' THEN 'pv is constant' END,
       CASE WHEN name IN ('FIC103', 'PIC200') THEN '{pv_quantised}' WHEN code = 'insufficient_data' THEN '{pv_constant}' ELSE '{}' END::text[],
       0.01, 0.1, 1e-9, code NOT IN ('healthy', 'not_controlling', 'insufficient_data'),
       CASE WHEN code NOT IN ('healthy', 'not_controlling', 'insufficient_data') THEN 40 + loop_id / 100.0 END, 1e-9,
       0.2, 0.3, error_std, 120, 60, CASE code WHEN 'not_controlling' THEN 0.1 ELSE 1 END,
       CASE code WHEN 'not_controlling' THEN 'mode' END, CASE code WHEN 'not_controlling' THEN slot_end - interval '1 h' END
FROM told;
INSERT INTO verdict (loop_id, slot_end, algorithm_revision, input_revision, analysis_id, code, confidence, summary, reasons, action)
SELECT loop_id, slot_end, 1, 1, analysis_id, code, 0.9, 'What is the matter with ' || name, '{first,"second, with a comma"}', 'Go and look.'
FROM told;
UPDATE schedule SET last_slot_end = told.slot_end, result_slot_end = told.slot_end, visible_at = now() + interval '1 h',
       attempts = CASE WHEN told.name = 'DEAD1' THEN 2 ELSE 0 END,
       last_error = CASE WHEN told.name = 'DEAD1' THEN 'tag unknown' END
FROM told WHERE told.loop_id = schedule.loop_id AND told.age_days = 0;

INSERT INTO explanation_step (loop_id, slot_end, algorithm_revision, input_revision, step, effect, parameters, intervals,
                              holdout_error_before, holdout_error_after, statement, asked_by)
SELECT loop_id, slot_end, 1, 1, 1, 'valve_stiction', '{"S": 4.2}', '{}', 1.0, 0.25, 'The valve sticks.',
       '[{"test": "op_direction", "p": 1e-40, "p_after": 0.31, "statement": "It depends on which way op last went."}]'
FROM told WHERE name = 'FIC101' AND age_days = 0;
-- Late rows changed a verdict of NEW1, five days ago.
INSERT INTO verdict (loop_id, slot_end, algorithm_revision, input_revision, analysis_id, code, confidence, summary, reasons, action)
SELECT loop_id, slot_end, 1, 2, analysis_id, 'sensor_fault', 0.5, 'late', '{}', '' FROM told WHERE name = 'NEW1' AND age_days = 5;

INSERT INTO standing_problem (loop_id, code, role, first_slot, last_slot, slots, last_row)
SELECT loop_id, 'dead_tag', 'pv', slot_end, slot_end, 9, slot_end - interval '5 days' FROM told WHERE name = 'DEAD1' AND age_days = 0;
INSERT INTO stage_cost VALUES (date_trunc('hour', now()), 'host', 0, 9, 9, 4, 1000, 1, 1, 1, 1, 1, 1, 1, 1);
INSERT INTO worker (worker, program_version, algorithm_revision, held_loops, lost_leases) VALUES ('host/1', '1', 1, 0, 0);

INSERT INTO maintenance_event (loop_id, done_at, kind, description)
SELECT loop_id, now() - interval '30 days', CASE name WHEN 'TIC400' THEN 'valve' ELSE 'tuning' END, 'mended'
FROM loop WHERE name IN ('TIC400', 'PIC200');
INSERT INTO annotation (loop_id, kind, code, reason) SELECT loop_id, 'acknowledged', 'valve_stiction', 'order 4711' FROM loop WHERE name = 'LIC300';
INSERT INTO annotation (loop_id, kind, until, reason) SELECT loop_id, 'suppressed', now() + interval '7 days', 'shutdown' FROM loop WHERE name = 'OFF1';
INSERT INTO annotation (loop_id, kind, withdrawn_at) SELECT loop_id, 'false_positive', now() FROM loop WHERE name = 'FIC101';

INSERT INTO plant_round (slot_end, algorithm_revision, loops, oscillating, events) SELECT max(slot_end), 1, 8, 2, 1 FROM told;
INSERT INTO plant_oscillation (slot_end, algorithm_revision, number, period_s, loop_ids, strengths, lags_s, source_loop_id, statement, roles, scores, p)
SELECT max(slot_end), 1, 1, 40, array_agg(DISTINCT loop_id ORDER BY loop_id), '{0.9,0.7}', '{0,3}', min(loop_id), 'FIC101 is the most nonlinear',
       '{source,victim}', '{2.5,0.5}', 1e-6
FROM told WHERE name IN ('FIC101', 'FIC102');

INSERT INTO flag_notice (loop_id, code, flagged_at, announced, slot_end, since, status, confidence, rank, score, summary, ended_at, ended_by)
SELECT loop_id, code, now() - came * interval '1 day', true, now() - came * interval '1 day', now() - came * interval '1 day',
       'confirmed', 0.9, 1, 0.7, 'What is the matter with ' || name, now() - went * interval '1 day',
       CASE WHEN went IS NOT NULL THEN 'verdict' END
FROM (VALUES ('FIC101', 'valve_stiction', 50, 40), ('FIC101', 'valve_stiction', 20, NULL), ('TIC400', 'valve_deadband', 60, 30),
             ('PIC200', 'tight_tuning', 10, NULL), ('NEW1', 'valve_stiction', 1, NULL)) AS stay (name, code, came, went)
JOIN loop USING (name);
COMMIT;
ANALYZE;
