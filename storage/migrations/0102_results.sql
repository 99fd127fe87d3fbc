-- What the program finds: analyses with their verdicts by month, oscillations that loops share, problems of data,
-- stays on the list and what came of repairs.

CREATE SEQUENCE loopscope.analysis_id AS bigint;
COMMENT ON SEQUENCE loopscope.analysis_id IS 'Numbers of analyses';

-- Four tables grow with time and are partitioned by month of slot_end; no foreign key ties them to each other, because
-- a month could not be dropped then. Columns at the end are null in rows of programs that did not know them.
CREATE TABLE loopscope.analysis (
  loop_id            bigint NOT NULL REFERENCES loopscope.loop ON DELETE CASCADE,
  slot_end           timestamptz NOT NULL,
  algorithm_revision integer NOT NULL,
  analysis_id        bigint NOT NULL DEFAULT nextval('loopscope.analysis_id'),
  input_revision     integer NOT NULL DEFAULT 1,
  fence              bigint NOT NULL,
  analysed_at        timestamptz NOT NULL DEFAULT now(),
  program_version    text NOT NULL,
  settings           jsonb NOT NULL,
  input_digest       text NOT NULL,
  fetch_ms           double precision NOT NULL,
  analyse_ms         double precision NOT NULL,

  window_start       timestamptz NOT NULL,
  window_end         timestamptz NOT NULL,
  samples            bigint NOT NULL,
  interval_s         double precision NOT NULL,

  usable              boolean NOT NULL,
  unusable_reason     text,
  flags               text[] NOT NULL,
  missing_fraction    double precision,
  compression_factor  double precision,
  quantisation_factor double precision,
  saturated_fraction  double precision,

  segments           integer,
  bifrequencies      integer,
  mean_bic2          double precision,
  std_bic2           double precision,
  max_bic2           double precision,
  critical_mean_bic2 double precision,
  ngi                double precision,
  nli                double precision,
  published_gaussian boolean,
  published_linear   boolean,
  skewness           double precision,
  excess_kurtosis    double precision,
  ngi_p              double precision,
  nli_p              double precision,
  cubic_p            double precision,
  nonlinear_p        double precision,
  coupling           text,
  hos_slow           jsonb,

  oscillating             boolean NOT NULL,
  oscillation_period_s    double precision,
  oscillation_regularity  double precision,
  oscillation_amplitude   double precision,
  oscillation_persistence double precision,
  oscillation_p           double precision,

  harris_low         double precision,
  harris_high        double precision,
  harris_p           double precision,
  error_std          double precision,
  valve_travel_per_h double precision,
  reversals_per_h    double precision,
  auto_fraction      double precision,
  at_limit_fraction  double precision,

  horch_dtau         double precision,
  horch_drho         double precision,
  shape_index        double precision,
  ellipse_stiction   double precision,
  ellipse_r2         double precision,
  mv_op_width        double precision,
  mv_slip_jump       double precision,
  mv_stuck_fraction  double precision,

  model_excited              boolean,
  model_error_kind           text,
  model_noise_floor          double precision,
  model_baseline_error       double precision,
  model_unexplained_fraction double precision,
  model                      jsonb,

  prepare_ms            double precision,
  statistics_ms         double precision,
  model_ms              double precision,
  error_log_variance_se double precision,

  -- What the tests rest on, and what else was found about the noise.
  innovation_p         double precision,
  tested_on            text,
  heavy_tails_p        double precision,
  variance_changes_p   double precision,

  -- Several windows of a loop make one verdict.
  combined_probabilities real[],
  combined_evidence      real[],
  combined_windows       real[],

  control_fraction double precision,
  control_lost_by  text,
  control_lost_at  timestamptz,
  op_range_doubt   text,
  past_pv_flat_s   double precision,
  past_pv_step     double precision,

  PRIMARY KEY (loop_id, slot_end, algorithm_revision)
) PARTITION BY RANGE (slot_end);
CREATE INDEX analysis_by_id ON loopscope.analysis (analysis_id);
-- For questions over all loops of some days: a few kilobytes, where a b-tree would cost megabytes.
CREATE INDEX analysis_by_slot ON loopscope.analysis USING brin (slot_end);
COMMENT ON TABLE loopscope.analysis IS
  'Everything measured on one window of one loop: one row per loop, slot and algorithm revision; late data update the '
  'row';
COMMENT ON COLUMN loopscope.analysis.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.analysis.slot_end IS
  'End of the slot that the analysis is for; the schedule sets it, so a second run finds the same slot';
COMMENT ON COLUMN loopscope.analysis.algorithm_revision IS
  'Raised whenever the program may judge the same data differently';
COMMENT ON COLUMN loopscope.analysis.analysis_id IS 'Number of the analysis, kept when its input is revised';
COMMENT ON COLUMN loopscope.analysis.input_revision IS
  '1 at first, raised each time late or corrected data changed the input';
COMMENT ON COLUMN loopscope.analysis.fence IS 'Fence of the claim that wrote the row';
COMMENT ON COLUMN loopscope.analysis.analysed_at IS 'When the row was written';
COMMENT ON COLUMN loopscope.analysis.program_version IS 'Version of the program that wrote the row';
COMMENT ON COLUMN loopscope.analysis.settings IS 'Analysis settings in force, every key';
COMMENT ON COLUMN loopscope.analysis.input_digest IS
  'Digest of every sample that was read and of the settings, 16 hexadecimal digits: equal digests, equal results';
COMMENT ON COLUMN loopscope.analysis.fetch_ms IS
  'Time for reading the rows, milliseconds, the loop''s share of its batch';
COMMENT ON COLUMN loopscope.analysis.analyse_ms IS
  'Time for the analysis, milliseconds: prepare_ms, statistics_ms, model_ms and the verdict';
COMMENT ON COLUMN loopscope.analysis.window_start IS 'First sample of the window';
COMMENT ON COLUMN loopscope.analysis.window_end IS 'Last sample of the window';
COMMENT ON COLUMN loopscope.analysis.samples IS 'Grid slots in the window';
COMMENT ON COLUMN loopscope.analysis.interval_s IS 'Sample interval, seconds; 0 = unknown';
COMMENT ON COLUMN loopscope.analysis.usable IS
  'Whether the statistics could be computed and a controller acted: false also for not_controlling and for a '
  'measurement that stands still all the time';
COMMENT ON COLUMN loopscope.analysis.unusable_reason IS 'Why the data could not be judged; null when they could';
COMMENT ON COLUMN loopscope.analysis.flags IS 'What was odd about the data, e.g. short, sp_missing, op_range_unknown';
COMMENT ON COLUMN loopscope.analysis.missing_fraction IS 'Share of pv samples that are missing, 0 to 1';
COMMENT ON COLUMN loopscope.analysis.compression_factor IS 'Recorded grid over stored samples, 1 = not compressed';
COMMENT ON COLUMN loopscope.analysis.quantisation_factor IS 'Step of pv values over their standard deviation';
COMMENT ON COLUMN loopscope.analysis.saturated_fraction IS 'Share of op samples at a limit of its range, 0 to 1';
COMMENT ON COLUMN loopscope.analysis.segments IS 'Segments without a missing sample (K)';
COMMENT ON COLUMN loopscope.analysis.bifrequencies IS 'Bifrequencies of the principal domain (L)';
COMMENT ON COLUMN loopscope.analysis.mean_bic2 IS 'Mean squared bicoherence over the principal domain';
COMMENT ON COLUMN loopscope.analysis.std_bic2 IS 'Standard deviation of the squared bicoherence';
COMMENT ON COLUMN loopscope.analysis.max_bic2 IS 'Largest squared bicoherence';
COMMENT ON COLUMN loopscope.analysis.critical_mean_bic2 IS
  'Critical value of the mean squared bicoherence of a Gaussian signal (eq. 11)';
COMMENT ON COLUMN loopscope.analysis.ngi IS 'Non-Gaussianity index (eq. 12)';
COMMENT ON COLUMN loopscope.analysis.nli IS 'Nonlinearity index (eq. 14)';
COMMENT ON COLUMN loopscope.analysis.published_gaussian IS 'The published decision: the error signal is Gaussian';
COMMENT ON COLUMN loopscope.analysis.published_linear IS 'The published decision: the loop is linear';
COMMENT ON COLUMN loopscope.analysis.skewness IS 'Skewness of the error signal';
COMMENT ON COLUMN loopscope.analysis.excess_kurtosis IS 'Excess kurtosis of the error signal';
COMMENT ON COLUMN loopscope.analysis.ngi_p IS 'Calibrated p-value of the Gaussianity test; null = not computed';
COMMENT ON COLUMN loopscope.analysis.nli_p IS 'Calibrated p-value of the linearity test; null = not computed';
COMMENT ON COLUMN loopscope.analysis.cubic_p IS
  'Calibrated p-value of the test for symmetric nonlinearity; null = not computed';
COMMENT ON COLUMN loopscope.analysis.nonlinear_p IS
  'The three p-values combined: the one that decides; null = not computed';
COMMENT ON COLUMN loopscope.analysis.coupling IS
  'What the error signal couples: none_found, quadratic, cubic, both, or too_short: too few cycles for any to be found';
COMMENT ON COLUMN loopscope.analysis.hos_slow IS
  'The same statistics on data resampled to fit a long period, with decimation and samples (raw samples read for it); '
  'null = not needed, or too little recorded';
COMMENT ON COLUMN loopscope.analysis.oscillating IS 'Whether a regular oscillation is present';
COMMENT ON COLUMN loopscope.analysis.oscillation_period_s IS 'Its period, seconds';
COMMENT ON COLUMN loopscope.analysis.oscillation_regularity IS 'Regularity of its zero crossings, above 1 = regular';
COMMENT ON COLUMN loopscope.analysis.oscillation_amplitude IS 'Its amplitude, pv units';
COMMENT ON COLUMN loopscope.analysis.oscillation_persistence IS
  'Fourth over first peak of the autocorrelation, near 1 = sustained';
COMMENT ON COLUMN loopscope.analysis.oscillation_p IS
  'Probability that a record without an oscillation is called oscillating on evidence as strong; 1 = none present, '
  'null = not computed';
COMMENT ON COLUMN loopscope.analysis.harris_low IS
  'Harris index at the least favourable plausible delay, 1 = as good as any linear controller';
COMMENT ON COLUMN loopscope.analysis.harris_high IS 'Harris index at the most favourable plausible delay';
COMMENT ON COLUMN loopscope.analysis.harris_p IS
  'Probability that a well tuned loop (middle index 0.6) shows a Harris index this small; null = not computed';
COMMENT ON COLUMN loopscope.analysis.error_std IS 'Standard deviation of the error, pv units';
COMMENT ON COLUMN loopscope.analysis.valve_travel_per_h IS 'Sum of op movements, % of range per hour';
COMMENT ON COLUMN loopscope.analysis.reversals_per_h IS 'Changes of op''s direction per hour';
COMMENT ON COLUMN loopscope.analysis.auto_fraction IS 'Share of samples in automatic or cascade, 0 to 1';
COMMENT ON COLUMN loopscope.analysis.at_limit_fraction IS 'Share of samples with op at a limit, 0 to 1';
COMMENT ON COLUMN loopscope.analysis.horch_dtau IS
  'Horch''s delta tau of the op-pv cross-correlation, above 2/3 speaks for stiction';
COMMENT ON COLUMN loopscope.analysis.horch_drho IS
  'Horch''s delta rho of the op-pv cross-correlation, above 1/3 speaks for stiction';
COMMENT ON COLUMN loopscope.analysis.shape_index IS 'Triangular (1) or sinusoidal (0) half cycles';
COMMENT ON COLUMN loopscope.analysis.ellipse_stiction IS 'Apparent stiction from the pv-op ellipse, % of op span';
COMMENT ON COLUMN loopscope.analysis.ellipse_r2 IS 'Quality of the pv-op ellipse, below 0.5 = inconclusive';
COMMENT ON COLUMN loopscope.analysis.mv_op_width IS 'Width of the mv-op hysteresis, % of op range';
COMMENT ON COLUMN loopscope.analysis.mv_slip_jump IS
  'Mean jump of mv beyond op''s own move when it leaves rest, % of op range: the slip jump of a sticking valve';
COMMENT ON COLUMN loopscope.analysis.mv_stuck_fraction IS
  'Share of samples in which op moves and mv stands still, 0 to 1';
COMMENT ON COLUMN loopscope.analysis.model_excited IS
  'Whether op moves enough for the loop model to claim anything; null = no model';
COMMENT ON COLUMN loopscope.analysis.model_error_kind IS
  'Kind of all model errors of this row and its steps: one_step, simulation or another documented one; null = no model';
COMMENT ON COLUMN loopscope.analysis.model_noise_floor IS 'What a perfect model would leave, pv units squared';
COMMENT ON COLUMN loopscope.analysis.model_baseline_error IS
  'Mean squared error of the model without any effect on unseen samples, pv units squared';
COMMENT ON COLUMN loopscope.analysis.model_unexplained_fraction IS
  'Share of the explainable error that the final model leaves, 0 to 1';
COMMENT ON COLUMN loopscope.analysis.model IS
  'The loop model but its steps: excitation, baseline (description, process), asked (effects that residual tests '
  'asked for at first), unexplained, questions, closed_loop; null = no model. Steps: explanation_step';
COMMENT ON COLUMN loopscope.analysis.prepare_ms IS 'Time for masks, gaps, archive and oscillation, milliseconds';
COMMENT ON COLUMN loopscope.analysis.statistics_ms IS
  'Time for the higher-order statistics, shapes and performance, milliseconds';
COMMENT ON COLUMN loopscope.analysis.model_ms IS 'Time for the loop model, milliseconds; null = none was fitted';
COMMENT ON COLUMN loopscope.analysis.error_log_variance_se IS
  'Standard error of ln(error_std^2), from the autocorrelation of the squared error; null = not computed, or written '
  'before schema version 13';
COMMENT ON COLUMN loopscope.analysis.innovation_p IS
  'p of the innovations depending on squares or cubes of the past; null = not asked, since the noise is normal or '
  'nothing was near significance';
COMMENT ON COLUMN loopscope.analysis.tested_on IS
  'What the p-values rest on: error (sp - pv), or model_residual, the error less the linear answer to a setpoint that '
  'moves all the time';
COMMENT ON COLUMN loopscope.analysis.heavy_tails_p IS 'p against normal noise of the outliers in what drives the loop';
COMMENT ON COLUMN loopscope.analysis.variance_changes_p IS
  'p against noise of one strength of the bursts in what drives the loop';
COMMENT ON COLUMN loopscope.analysis.combined_probabilities IS
  'Probability of each cause by this window and those before it, in the order of verdict.cause_probabilities; follows '
  'from the stored rows (core/diagnosis/combined_odds); null = the window could not be judged, or a program before '
  'schema 22';
COMMENT ON COLUMN loopscope.analysis.combined_evidence IS
  'Weighted mean of the log odds of each cause beyond its prior, of this window and those before it';
COMMENT ON COLUMN loopscope.analysis.combined_windows IS
  'For each cause, as many windows that share no sample would weigh as much: new samples count, old windows are '
  'forgotten';
COMMENT ON COLUMN loopscope.analysis.control_fraction IS
  'Share of the window in which a controller acted, by the mode or by op; null = neither is recorded, or a program '
  'before schema 23';
COMMENT ON COLUMN loopscope.analysis.control_lost_by IS
  'What says that none did: mode (manual, tracking, out of service) or constant_output; null = one acted all the time';
COMMENT ON COLUMN loopscope.analysis.control_lost_at IS
  'Start of the stretch without a controller that lasts up to the window''s end, as far as the window shows; null = '
  'one acts at the end';
COMMENT ON COLUMN loopscope.analysis.op_range_doubt IS
  'Why the range of op in the catalogue cannot be right; null = it can, or none is set';
COMMENT ON COLUMN loopscope.analysis.past_pv_flat_s IS
  'schedule.pv_flat_s as it was when this window was judged; null = nothing was known';
COMMENT ON COLUMN loopscope.analysis.past_pv_step IS
  'schedule.pv_step as it was when this window was judged; null = nothing was known';

CREATE TABLE loopscope.bicoherence_peak (
  loop_id            bigint NOT NULL,
  slot_end           timestamptz NOT NULL,
  algorithm_revision integer NOT NULL,
  input_revision     integer NOT NULL,
  rank               integer NOT NULL CHECK (rank > 0),
  f1                 double precision NOT NULL,
  f2                 double precision NOT NULL,
  bic2               double precision NOT NULL,
  p                  double precision,
  PRIMARY KEY (loop_id, slot_end, algorithm_revision, input_revision, rank)
) PARTITION BY RANGE (slot_end);
COMMENT ON TABLE loopscope.bicoherence_peak IS 'Strongest distinct peaks of the squared bicoherence of an analysis';
COMMENT ON COLUMN loopscope.bicoherence_peak.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.bicoherence_peak.slot_end IS 'Slot of the analysis';
COMMENT ON COLUMN loopscope.bicoherence_peak.algorithm_revision IS 'Algorithm revision of the analysis';
COMMENT ON COLUMN loopscope.bicoherence_peak.input_revision IS 'Input revision that the peak belongs to';
COMMENT ON COLUMN loopscope.bicoherence_peak.rank IS '1 = strongest';
COMMENT ON COLUMN loopscope.bicoherence_peak.f1 IS 'First frequency, cycles per sample, 0 to 0.5';
COMMENT ON COLUMN loopscope.bicoherence_peak.f2 IS 'Second frequency, cycles per sample, not above f1';
COMMENT ON COLUMN loopscope.bicoherence_peak.bic2 IS 'Squared bicoherence there, 0 to 1';
COMMENT ON COLUMN loopscope.bicoherence_peak.p IS 'p-value corrected for the whole domain; null = not computed';

-- asked_by, what led the loop model to the effect, is null in steps of programs that did not say: they never claim
-- that no test asked.
CREATE TABLE loopscope.explanation_step (
  loop_id              bigint NOT NULL,
  slot_end             timestamptz NOT NULL,
  algorithm_revision   integer NOT NULL,
  input_revision       integer NOT NULL,
  step                 integer NOT NULL CHECK (step > 0),
  effect               text NOT NULL,
  parameters           jsonb NOT NULL,
  intervals            jsonb NOT NULL,
  holdout_error_before double precision,
  holdout_error_after  double precision,
  evidence             double precision,
  p                    double precision,
  margin               double precision,
  simulation_ratio     double precision,
  steadiness           double precision,
  statement            text NOT NULL,
  asked_by             jsonb,
  PRIMARY KEY (loop_id, slot_end, algorithm_revision, input_revision, step)
) PARTITION BY RANGE (slot_end);
COMMENT ON TABLE loopscope.explanation_step IS 'Effects that the loop model took in, in the order of what they explain';
COMMENT ON COLUMN loopscope.explanation_step.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.explanation_step.slot_end IS 'Slot of the analysis';
COMMENT ON COLUMN loopscope.explanation_step.algorithm_revision IS 'Algorithm revision of the analysis';
COMMENT ON COLUMN loopscope.explanation_step.input_revision IS 'Input revision that the step belongs to';
COMMENT ON COLUMN loopscope.explanation_step.step IS '1 = first effect taken in';
COMMENT ON COLUMN loopscope.explanation_step.effect IS 'Name of the effect, e.g. valve_stiction';
COMMENT ON COLUMN loopscope.explanation_step.parameters IS
  'Fitted parameters of the effect by name; law = the valve law that stiction was fitted by';
COMMENT ON COLUMN loopscope.explanation_step.intervals IS
  '90 % intervals of the parameters, [low, high] by name; a parameter without one is left out';
COMMENT ON COLUMN loopscope.explanation_step.holdout_error_before IS
  'Mean squared error on unseen samples without the effect, pv units squared; null = not finite';
COMMENT ON COLUMN loopscope.explanation_step.holdout_error_after IS 'The same with the effect';
COMMENT ON COLUMN loopscope.explanation_step.evidence IS 'n ln(before / after) over the n unseen samples';
COMMENT ON COLUMN loopscope.explanation_step.p IS
  'Probability that an effect which is not there lowers the error so far; null = not computed';
COMMENT ON COLUMN loopscope.explanation_step.margin IS 'Evidence less that of the best rival effect of another verdict';
COMMENT ON COLUMN loopscope.explanation_step.simulation_ratio IS
  'Mean square of the simulation error after the step by that before it; null = not computed';
COMMENT ON COLUMN loopscope.explanation_step.steadiness IS
  'Share of the record''s parts in which the effect lowers the error, 0 to 1';
COMMENT ON COLUMN loopscope.explanation_step.statement IS 'The step in one sentence';
COMMENT ON COLUMN loopscope.explanation_step.asked_by IS
  'Residual tests that asked for the effect, most significant first: [{test, p, p_after, statement}], p of the '
  'residual before the effect and after it (null = not asked again); [] = none asked, a first look showed it; null = '
  'of a program before schema 20';

-- Views ask for the code of every slot of a loop's past: with the code in the key's index they read the index alone,
-- where each row of the table would be on a page of its own. Probabilities of the causes lie in the catalogue's order
-- (core/diagnosis/verdicts), four bytes each, so that a slot stays one row.
CREATE TABLE loopscope.verdict (
  loop_id             bigint NOT NULL,
  slot_end            timestamptz NOT NULL,
  algorithm_revision  integer NOT NULL,
  input_revision      integer NOT NULL,
  analysis_id         bigint NOT NULL,
  code                text NOT NULL,
  confidence          double precision NOT NULL CHECK (confidence BETWEEN 0 AND 1),
  summary             text NOT NULL,
  reasons             text[] NOT NULL,
  action              text NOT NULL,
  decided_at          timestamptz NOT NULL DEFAULT now(),
  p                   double precision CHECK (p BETWEEN 0 AND 1),
  cause_probabilities real[],
  cause_evidence      real[],
  PRIMARY KEY (loop_id, slot_end, algorithm_revision, input_revision) INCLUDE (code)
) PARTITION BY RANGE (slot_end);
CREATE INDEX verdict_by_slot ON loopscope.verdict USING brin (slot_end);
-- Rows that arrive late change what a slot's window holds: the analysis is revised, its former verdict stays.
CREATE INDEX verdict_revised ON loopscope.verdict (decided_at) WHERE input_revision > 1;
COMMENT ON TABLE loopscope.verdict IS 'What follows from an analysis; one row per input revision, former verdicts stay';
COMMENT ON COLUMN loopscope.verdict.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.verdict.slot_end IS 'Slot of the analysis';
COMMENT ON COLUMN loopscope.verdict.algorithm_revision IS 'Algorithm revision of the analysis';
COMMENT ON COLUMN loopscope.verdict.input_revision IS 'Input revision that the verdict rests on';
COMMENT ON COLUMN loopscope.verdict.analysis_id IS 'Number of the analysis';
COMMENT ON COLUMN loopscope.verdict.code IS 'The verdict; verdict_kind explains every code';
COMMENT ON COLUMN loopscope.verdict.confidence IS
  'Probability of the code, 0 to 1; before algorithm revision 16 a ranking';
COMMENT ON COLUMN loopscope.verdict.summary IS 'The verdict in one sentence';
COMMENT ON COLUMN loopscope.verdict.reasons IS 'Why, each reason with its numbers';
COMMENT ON COLUMN loopscope.verdict.action IS 'What to do next';
COMMENT ON COLUMN loopscope.verdict.decided_at IS 'When the verdict was written';
COMMENT ON COLUMN loopscope.verdict.p IS
  'Probability of evidence as strong as what the verdict rests on, were the loop without that fault; null = it rests '
  'on a fact, or nothing was tested';
COMMENT ON COLUMN loopscope.verdict.cause_probabilities IS
  'Probability of each cause, 0 to 1, in the order of verdict_kind up to nonlinear_unexplained; causes may stand '
  'together; null = the data could not be judged, or a program before schema 21';
COMMENT ON COLUMN loopscope.verdict.cause_evidence IS
  'Log odds of each cause beyond its prior, in the order of cause_probabilities; null = nothing was weighed, or a '
  'program before schema 22';

-- Months of results: made ahead, dropped when they are old. A row whose month has no partition goes into DEFAULT and
-- is moved when its month is made, so that no result is ever refused.
CREATE FUNCTION loopscope.partitioned_tables() RETURNS text[] IMMUTABLE LANGUAGE sql
RETURN ARRAY['analysis', 'bicoherence_peak', 'explanation_step', 'verdict'];
COMMENT ON FUNCTION loopscope.partitioned_tables() IS 'The tables that are partitioned by month of slot_end';

-- LIKE and ATTACH instead of PARTITION OF: comments come along, and the parent stays open for writers (ATTACH locks it
-- SHARE UPDATE EXCLUSIVE, PARTITION OF would lock it ACCESS EXCLUSIVE). Months that maintain makes are read by whoever
-- reads the whole: pg_dump asks for each table by itself.
CREATE FUNCTION loopscope.new_partition_table(parent text, partition text, described text)
RETURNS void LANGUAGE plpgsql SET search_path = pg_catalog AS $$
DECLARE reader text;
BEGIN
  EXECUTE format('CREATE TABLE loopscope.%I (LIKE loopscope.%I INCLUDING ALL)', partition, parent);
  EXECUTE format('COMMENT ON TABLE loopscope.%I IS %L', partition, described);
  FOR reader IN
    SELECT granted.grantee::regrole FROM pg_class AS class CROSS JOIN aclexplode(class.relacl) AS granted
    WHERE class.oid = format('loopscope.%I', parent)::regclass
      AND granted.privilege_type = 'SELECT' AND granted.grantee NOT IN (0, class.relowner)
  LOOP
    EXECUTE format('GRANT SELECT ON loopscope.%I TO %s', partition, reader);
  END LOOP;
END $$;
COMMENT ON FUNCTION loopscope.new_partition_table(text, text, text) IS
  'An empty table that can become a partition of parent, read by whoever reads that';

DO $$
DECLARE parent text;
BEGIN
  FOREACH parent IN ARRAY loopscope.partitioned_tables() LOOP
    PERFORM loopscope.new_partition_table(parent, parent || '_default',
      format('Rows of %s whose month has no partition', parent));
    EXECUTE format('ALTER TABLE loopscope.%I ATTACH PARTITION loopscope.%I DEFAULT', parent, parent || '_default');
  END LOOP;
END $$;

-- Of a database that was taken over these were widened without reading its rows (NOT VALID), which had satisfied the
-- narrower check of before. They stand here in the same words, so that there is one schema and not two.
ALTER TABLE loopscope.analysis
  ADD CONSTRAINT analysis_coupling_check
    CHECK (coupling IN ('none_found', 'quadratic', 'cubic', 'both', 'too_short')) NOT VALID,
  ADD CONSTRAINT analysis_tested_on_check CHECK (tested_on IN ('error', 'model_residual')) NOT VALID,
  ADD CONSTRAINT analysis_control_lost_by_check CHECK (control_lost_by IN ('mode', 'constant_output')) NOT VALID;
ALTER TABLE loopscope.verdict ADD CONSTRAINT verdict_code_check CHECK (code IN (
  'healthy', 'valve_stiction', 'valve_deadband', 'valve_saturation', 'valve_characteristic', 'valve_oversized',
  'process_nonlinearity', 'external_disturbance', 'process_change', 'sensor_fault', 'tight_tuning', 'sluggish_tuning',
  'nonlinear_unexplained', 'unexplained', 'not_controlling', 'insufficient_data')) NOT VALID;

CREATE FUNCTION loopscope.make_partition(parent text, month timestamptz) RETURNS text LANGUAGE plpgsql
SET search_path = pg_catalog SET timezone = 'UTC' AS $$
DECLARE
  from_time timestamptz := date_trunc('month', month);
  to_time   timestamptz := date_trunc('month', month) + interval '1 month';
  partition text := parent || to_char(month, '_YYYY_MM');
BEGIN
  IF to_regclass(format('loopscope.%I', partition)) IS NOT NULL THEN
    RETURN NULL;
  END IF;
  PERFORM loopscope.new_partition_table(parent, partition,
    format('Rows of %s with slot_end in %s', parent, to_char(month, 'YYYY-MM')));
  -- Before the attachment: PostgreSQL refuses it while DEFAULT holds rows of the month. The lock
  -- keeps a worker from adding one in between.
  EXECUTE format('LOCK TABLE loopscope.%I IN ACCESS EXCLUSIVE MODE', parent || '_default');
  EXECUTE format('WITH moved AS (DELETE FROM loopscope.%I WHERE slot_end >= %L AND slot_end < %L RETURNING *)
                  INSERT INTO loopscope.%I SELECT * FROM moved',
                 parent || '_default', from_time, to_time, partition);
  EXECUTE format('ALTER TABLE loopscope.%I ATTACH PARTITION loopscope.%I FOR VALUES FROM (%L) TO (%L)',
                 parent, partition, from_time, to_time);
  RETURN partition;
END $$;
COMMENT ON FUNCTION loopscope.make_partition(text, timestamp with time zone) IS
  'Makes the partition of parent for the month (UTC) and moves its rows out of DEFAULT; returns its name, null when '
  'it exists';

CREATE FUNCTION loopscope.make_partitions(first_month timestamptz, months integer)
RETURNS SETOF text LANGUAGE sql SET search_path = pg_catalog SET timezone = 'UTC' AS $$
  SELECT made.name
  FROM generate_series(0, months - 1) AS ahead(n)
  CROSS JOIN unnest(loopscope.partitioned_tables()) AS parent(name)
  CROSS JOIN LATERAL loopscope.make_partition(
    parent.name, date_trunc('month', first_month) + make_interval(months => ahead.n)) AS made(name)
  WHERE made.name IS NOT NULL
$$;
COMMENT ON FUNCTION loopscope.make_partitions(timestamp with time zone, integer) IS
  'Makes the partitions of so many months from first_month on; returns the names of the new ones';

CREATE FUNCTION loopscope.expired_partitions(before timestamptz) RETURNS SETOF text LANGUAGE sql STABLE
SET search_path = pg_catalog AS $$
  SELECT child.relname::text
  FROM pg_inherits AS inherits
  JOIN pg_class AS child ON child.oid = inherits.inhrelid
  JOIN pg_class AS parent ON parent.oid = inherits.inhparent
  JOIN pg_namespace AS namespace ON namespace.oid = parent.relnamespace
  WHERE namespace.nspname = 'loopscope'
    AND parent.relname = ANY (loopscope.partitioned_tables())
    AND substring(pg_get_expr(child.relpartbound, child.oid) FROM $re$ TO \('([^']+)'\)$re$)::timestamptz <= before
  ORDER BY parent.relname = 'analysis', child.relname
$$;
COMMENT ON FUNCTION loopscope.expired_partitions(timestamp with time zone) IS
  'Monthly partitions that end not after `before`; those of analysis last, so that no verdict ever lacks its analysis';

-- Not DETACH CONCURRENTLY, which PostgreSQL refuses beside a DEFAULT partition: the parent is locked for the moment of
-- the drop, so each one is dropped in a transaction of its own.
CREATE FUNCTION loopscope.drop_partition(name text) RETURNS void LANGUAGE plpgsql
SET search_path = pg_catalog AS $$
BEGIN
  EXECUTE format('DROP TABLE loopscope.%I', name);
END $$;
COMMENT ON FUNCTION loopscope.drop_partition(text) IS 'Drops one of expired_partitions() with its rows';

-- Results have a time of their own: their newest slot. Nothing is expired by a clock that has run on without them.
CREATE FUNCTION loopscope.newest_result() RETURNS timestamptz LANGUAGE sql STABLE SET search_path = pg_catalog AS $$
  SELECT max(slot_end) FROM loopscope.analysis WHERE slot_end <= now()
$$;
COMMENT ON FUNCTION loopscope.newest_result() IS
  'Newest slot with a stored analysis that is not after now(); null = none';

-- Oscillations that loops share, found in rounds: one that finds nothing supersedes the one before.
CREATE TABLE loopscope.plant_round (
  slot_end           timestamptz,
  algorithm_revision integer,
  loops              integer NOT NULL CHECK (loops >= 0),
  oscillating        integer NOT NULL CHECK (oscillating >= 0),
  events             integer NOT NULL CHECK (events >= 0),
  found_at           timestamptz NOT NULL DEFAULT now(),
  PRIMARY KEY (slot_end, algorithm_revision)
);
COMMENT ON TABLE loopscope.plant_round IS 'Comparisons across all loops, one row each; the newest one holds';
COMMENT ON COLUMN loopscope.plant_round.slot_end IS 'Slot of the verdict that was flagged first';
COMMENT ON COLUMN loopscope.plant_round.loops IS 'Loops that were looked at';
COMMENT ON COLUMN loopscope.plant_round.oscillating IS 'Of those, loops that oscillate';
COMMENT ON COLUMN loopscope.plant_round.events IS
  'Oscillations that several of them share: plant_oscillation has one row each, numbered from 1';

CREATE TABLE loopscope.plant_oscillation (
  slot_end           timestamptz NOT NULL,
  algorithm_revision integer NOT NULL,
  number             integer NOT NULL CHECK (number > 0),
  period_s           double precision NOT NULL CHECK (period_s > 0),
  loop_ids           bigint[] NOT NULL CHECK (cardinality(loop_ids) >= 2),
  strengths          double precision[] NOT NULL,
  lags_s             double precision[] NOT NULL,
  source_loop_id     bigint REFERENCES loopscope.loop ON DELETE SET NULL,
  statement          text NOT NULL,
  found_at           timestamptz NOT NULL DEFAULT now(),
  roles              text[],
  scores             double precision[],
  p                  double precision CHECK (p BETWEEN 0 AND 1),
  -- What a reader is shown of it: the odds and what speaks for and against each loop as its source, who foretells whom,
  -- trends and spectra. Programs that did not know it leave all of it null.
  outside            double precision CHECK (outside BETWEEN 0 AND 1),
  reasons            text[],
  leads              jsonb,
  traces             jsonb,
  PRIMARY KEY (slot_end, algorithm_revision, number),
  CONSTRAINT plant_oscillation_members CHECK (
    cardinality(strengths) = cardinality(loop_ids) AND cardinality(lags_s) = cardinality(loop_ids)),
  CONSTRAINT plant_oscillation_roles CHECK (
    (roles IS NULL OR cardinality(roles) = cardinality(loop_ids))
    AND (scores IS NULL OR cardinality(scores) = cardinality(loop_ids))
    AND roles <@ ARRAY['source', 'victim', 'cascade_slave', 'cascade_master', 'member']),
  CONSTRAINT plant_oscillation_reasons CHECK (reasons IS NULL OR cardinality(reasons) = cardinality(loop_ids)),
  CONSTRAINT plant_oscillation_lists CHECK (jsonb_typeof(leads) = 'array' AND jsonb_typeof(traces) = 'array')
);
COMMENT ON TABLE loopscope.plant_oscillation IS 'Oscillations that several loops share, with their likely source';
COMMENT ON COLUMN loopscope.plant_oscillation.slot_end IS 'End of the slot that was compared across loops';
COMMENT ON COLUMN loopscope.plant_oscillation.algorithm_revision IS
  'Raised whenever the program may judge the same data differently';
COMMENT ON COLUMN loopscope.plant_oscillation.number IS '1 = the oscillation with the most loops';
COMMENT ON COLUMN loopscope.plant_oscillation.period_s IS 'Shared period, seconds';
COMMENT ON COLUMN loopscope.plant_oscillation.loop_ids IS 'Numbers of the loops that share it';
COMMENT ON COLUMN loopscope.plant_oscillation.strengths IS
  'Share of each loop''s error variance at that period, 0 to 1, in the order of loop_ids';
COMMENT ON COLUMN loopscope.plant_oscillation.lags_s IS
  'How much later than the source each loop swings, seconds, in the order of loop_ids';
COMMENT ON COLUMN loopscope.plant_oscillation.source_loop_id IS
  'Loop that most likely causes it; null = outside or unknown';
COMMENT ON COLUMN loopscope.plant_oscillation.statement IS 'Why that loop, in words';
COMMENT ON COLUMN loopscope.plant_oscillation.found_at IS 'When the row was written';
COMMENT ON COLUMN loopscope.plant_oscillation.roles IS
  'What each loop is to it, in the order of loop_ids: source, victim, cascade_slave, cascade_master or member (keeps '
  'its place on the list); null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation.scores IS
  'Probability of each loop of being the source, in the order of loop_ids; of a program before revision 26: how much '
  'speaks for it, higher = more; null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation.p IS
  'Chance that loops which have nothing to do with each other agree so well; null = not computed';
COMMENT ON COLUMN loopscope.plant_oscillation.outside IS
  'Probability that none of the loops is the source: it lies outside of what is recorded; null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation.reasons IS
  'What speaks for and against each loop as the source, a sentence a line, in the order of loop_ids; null = not said';
COMMENT ON COLUMN loopscope.plant_oscillation.leads IS
  'Which loop''s past foretells which one''s future, strongest first: [{from_loop_id, to_loop_id, gain, direct}], '
  'gain = ln(error before / after) of the forecast, direct = the same of what no other member tells as well; null = '
  'not said';
COMMENT ON COLUMN loopscope.plant_oscillation.traces IS
  'What is drawn of the loops that it shakes most: [{loop_id, start_us, step_s, error, periods_s, power}], means of '
  'sp - pv over the last twelve periods from start_us (microseconds since 1970) on, and the spectrum of the whole '
  'window as share of the variance per unit of ln(period); null = not kept';

-- What keeps a loop from being judged, or makes a verdict worth less, with the tag to repair. A flag of the analysis
-- needs a row here to be put into words; one without is shown as it is.
CREATE TABLE loopscope.data_problem_kind (
  code   text PRIMARY KEY CHECK (code <> ''),
  role   text CHECK (role IN ('sp', 'pv', 'op', 'mv', 'mode')),
  shown  boolean NOT NULL,
  words  text NOT NULL,
  remedy text NOT NULL
);
COMMENT ON TABLE loopscope.data_problem_kind IS
  'Every flag and every other problem of data in words; a new flag needs one row here, without it is shown as it is';
COMMENT ON COLUMN loopscope.data_problem_kind.code IS
  'Flag of analysis.flags, or code of a problem that the monitor sees on the tag itself';
COMMENT ON COLUMN loopscope.data_problem_kind.role IS 'What of the loop it is about; null = the problem itself says so';
COMMENT ON COLUMN loopscope.data_problem_kind.words IS 'What it means, in words';

INSERT INTO loopscope.data_problem_kind (code, role, shown, words, remedy) VALUES
  ('insufficient_data', 'pv', true, 'The loop cannot be judged',
   'Correct what the reason names; see the other problems of the loop'),
  ('no_rows', NULL, true, 'The historian has no row of this tag',
   'Correct the tag in the catalogue (loopscope loops check), or have the historian record it'),
  ('dead_tag', NULL, true, 'The tag has stopped: its newest row is old', 'Check collector, interface and transmitter'),
  ('bad_quality', NULL, true, 'Most rows of the window are of bad quality', 'Check transmitter, wiring and interface'),
  ('future_rows', NULL, true, 'Rows are stamped in the future; they are not read',
   'Mend the clock or the time zone of the sender'),
  ('pv_constant', 'pv', true, 'pv does not vary',
   'Check transmitter and archive; a dead band may be wider than the noise'),
  ('pv_frozen', 'pv', true, 'pv stands still although it should not',
   'Compare with a second measurement; check transmitter and archive; out of service if the process stands'),
  ('pv_held', 'pv', true, 'pv is renewed too seldom: compression or a slow scan',
   'Lower exception and compression deviation of the tag, or scan it faster'),
  ('pv_quantised', 'pv', true, 'The steps of pv are coarse beside its own spread',
   'Narrow the range of the transmitter, or record more digits'),
  ('pv_spikes', 'pv', true, 'Isolated outliers of pv were taken out', 'Check wiring, shielding and interface'),
  ('sp_missing', 'sp', true, 'No set point: the mean of pv stands in',
   'Name the sp tag in the catalogue and have it recorded'),
  ('sp_moving', 'sp', false, 'The set point moves all the time (cascade or ratio)', ''),
  ('sp_steps_masked', 'sp', false, 'Steps of the set point were kept out of the statistics', ''),
  ('sp_not_followed', 'sp', true,
   'pv stays far from the set point: the controller is not in command, or the tag is another loop''s',
   'Check that sp and pv belong together; disable the loop if something else holds the valve'),
  ('op_missing', 'op', true, 'No controller output: model and valve cannot be judged',
   'Name the op tag in the catalogue and have it recorded'),
  ('op_constant', 'op', true, 'The controller output does not move',
   'Check mode and tag; a dead band of the archive may be too wide'),
  ('op_range_unknown', 'op', true, 'The controller output does not fit into 0 to 100 and its range is not given',
   'Set op_low and op_high in the catalogue'),
  ('manual_mode', 'mode', true, 'The controller was in manual for part of the window',
   'Nothing, if it is meant to be so'),
  ('repeated_times', 'pv', true, 'Rows have the same time; the last one counts',
   'Check the writer for repeated sending'),
  ('short', 'pv', true, 'Fewer than 32 segments: findings count less',
   'Record without gaps, or wait until the window is full'),
  ('unknown_quality', NULL, true, 'Rows have a quality code that the settings do not know; they count as bad',
   'Add the code to good_codes or bad_codes of the historian, or correct quality_rule'),
  ('rows_too_dense', NULL, true, 'The window was cut off: the tag has more than two rows a sample',
   'Correct interval_s of the loop, or stop the writer from sending rows again'),
  ('tests_refused', 'pv', true, 'Too little of pv was stored, or too little of it is steady, for some tests',
   'Lower exception and compression deviation of the tag, or scan it faster'),
  ('pv_compressed', 'pv', true,
   'The archive stored only part of pv (exception reporting, dead band or swinging door)',
   'Lower exception and compression deviation of the tag'),
  ('samples_drawn', 'pv', false, 'What the archive did not store was drawn for the tests', ''),
  ('pv_frozen_masked', 'pv', true, 'pv stands still for a while as if frozen; that stretch was left out',
   'Check transmitter, interface and archive'),
  ('not_stationary', 'pv', true, 'The loop changed within the window; the tests see its longest steady stretch only',
   'Note what was changed; analyse the time before and after apart'),
  ('pv_dead', 'pv', false, 'pv stands still up to the end of the window', ''),
  ('not_controlling', 'mode', true, 'No controller acts',
   'Nothing, if it is meant to be so; else put the controller in automatic'),
  ('op_range_inferred', 'op', false, 'The range of op was inferred from its values',
   'Set op_low and op_high in the catalogue (loopscope loops check proposes them)'),
  ('op_range_doubted', 'op', true, 'The range of op in the catalogue cannot be right',
   'Correct op_low and op_high in the catalogue (loopscope loops check proposes them)');

CREATE TABLE loopscope.standing_problem (
  loop_id       bigint NOT NULL REFERENCES loopscope.loop ON DELETE CASCADE,
  code          text NOT NULL,
  role          text NOT NULL CHECK (role IN ('', 'sp', 'pv', 'op', 'mv', 'mode')),
  first_slot    timestamptz NOT NULL,
  last_slot     timestamptz NOT NULL,
  previous_slot timestamptz,
  slots         integer NOT NULL CHECK (slots > 0),
  last_row      timestamptz,
  figure        double precision,
  PRIMARY KEY (loop_id, code, role)
) WITH (fillfactor = 80, autovacuum_vacuum_scale_factor = 0.02);
COMMENT ON TABLE loopscope.standing_problem IS
  'Since when each problem of a loop''s data stands: read it through data_problem';
COMMENT ON COLUMN loopscope.standing_problem.loop_id IS 'Number of the loop';
COMMENT ON COLUMN loopscope.standing_problem.code IS 'See data_problem_kind';
COMMENT ON COLUMN loopscope.standing_problem.role IS 'Tag that it is about; empty = as data_problem_kind says';
COMMENT ON COLUMN loopscope.standing_problem.first_slot IS 'First slot of the unbroken row of slots';
COMMENT ON COLUMN loopscope.standing_problem.last_slot IS
  'Newest slot that had it; it stands while that is the loop''s newest slot';
COMMENT ON COLUMN loopscope.standing_problem.previous_slot IS 'Slot of the loop before last_slot';
COMMENT ON COLUMN loopscope.standing_problem.slots IS 'Analysed slots in a row that had it';
COMMENT ON COLUMN loopscope.standing_problem.last_row IS
  'Time of the tag''s newest row; null = none, or not about rows';
COMMENT ON COLUMN loopscope.standing_problem.figure IS
  'How much of it: share of bad rows, number of rows in the future';

-- Who was told of what, and the history of the list: the list follows from what is stored.
CREATE TABLE loopscope.flag_notice (
  flag_notice_id bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  loop_id        bigint NOT NULL REFERENCES loopscope.loop ON DELETE CASCADE,
  code           text NOT NULL,
  flagged_at     timestamptz NOT NULL DEFAULT now(),
  announced      boolean NOT NULL,
  slot_end       timestamptz NOT NULL,
  since          timestamptz NOT NULL,
  status         text NOT NULL CHECK (status IN ('watch', 'confirmed')),
  confidence     double precision NOT NULL,
  rank           bigint NOT NULL,
  score          double precision NOT NULL,
  summary        text NOT NULL,
  confirmed_at   timestamptz,
  ended_at       timestamptz,
  ended_by       text CHECK (ended_by IN ('verdict', 'annotation', 'plant', 'disabled', 'threshold', 'state'))
);
CREATE UNIQUE INDEX flag_notice_open ON loopscope.flag_notice (loop_id, code) WHERE ended_at IS NULL;
CREATE INDEX flag_notice_of_loop ON loopscope.flag_notice (loop_id, flagged_at);
COMMENT ON TABLE loopscope.flag_notice IS
  'History of flagged_loop: one row per stay of a loop on the list, noted by whoever announces newly flagged loops '
  '(NOTIFY loopscope_flagged)';
COMMENT ON COLUMN loopscope.flag_notice.flag_notice_id IS 'Number of the notice';
COMMENT ON COLUMN loopscope.flag_notice.code IS
  'Verdict that it was flagged with; while the loop stays its verdict may become another one';
COMMENT ON COLUMN loopscope.flag_notice.flagged_at IS 'When it was seen on the list first';
COMMENT ON COLUMN loopscope.flag_notice.announced IS
  'Whether listeners were told; false = it had just left the list (parameter flag_quiet_hours)';
COMMENT ON COLUMN loopscope.flag_notice.slot_end IS 'Slot of the verdict that was flagged first';
COMMENT ON COLUMN loopscope.flag_notice.since IS 'Slot of the first verdict of the run at that time';
COMMENT ON COLUMN loopscope.flag_notice.status IS 'watch or confirmed, as it stands or stood last';
COMMENT ON COLUMN loopscope.flag_notice.confidence IS 'Confidence of that verdict, 0 to 1';
COMMENT ON COLUMN loopscope.flag_notice.rank IS 'Its rank at that time';
COMMENT ON COLUMN loopscope.flag_notice.score IS 'Its score at that time';
COMMENT ON COLUMN loopscope.flag_notice.summary IS 'What was said of it';
COMMENT ON COLUMN loopscope.flag_notice.confirmed_at IS 'When it was seen confirmed first; null = it was not yet';
COMMENT ON COLUMN loopscope.flag_notice.ended_at IS 'When it was found gone from the list; null = it stands';
COMMENT ON COLUMN loopscope.flag_notice.ended_by IS
  'What ended it: verdict (healthy again), annotation, plant (found to be a victim), disabled, state (no controller '
  'acts), or threshold (no longer probable enough)';
