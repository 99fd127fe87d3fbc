-- What an analysis found. The four tables grow with time and are partitioned by month of slot_end;
-- no foreign key ties them to each other, because a month could not be dropped then.

CREATE SEQUENCE loopscope.analysis_id AS bigint;
COMMENT ON SEQUENCE loopscope.analysis_id IS 'Numbers of analyses';

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
  coupling           text CHECK (coupling IN ('none_found', 'quadratic', 'cubic', 'both')),
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

  PRIMARY KEY (loop_id, slot_end, algorithm_revision)
) PARTITION BY RANGE (slot_end);
CREATE INDEX analysis_by_id ON loopscope.analysis (analysis_id);
-- For questions over all loops of some days: a few kilobytes, where a b-tree would cost megabytes.
CREATE INDEX analysis_by_slot ON loopscope.analysis USING brin (slot_end);

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
  PRIMARY KEY (loop_id, slot_end, algorithm_revision, input_revision, step)
) PARTITION BY RANGE (slot_end);

CREATE TABLE loopscope.verdict (
  loop_id            bigint NOT NULL,
  slot_end           timestamptz NOT NULL,
  algorithm_revision integer NOT NULL,
  input_revision     integer NOT NULL,
  analysis_id        bigint NOT NULL,
  code               text NOT NULL CHECK (code IN (
    'healthy', 'valve_stiction', 'valve_deadband', 'valve_saturation', 'valve_characteristic',
    'valve_oversized', 'process_nonlinearity', 'external_disturbance', 'process_change',
    'sensor_fault', 'tight_tuning', 'sluggish_tuning', 'nonlinear_unexplained', 'unexplained',
    'insufficient_data')),
  confidence         double precision NOT NULL CHECK (confidence BETWEEN 0 AND 1),
  summary            text NOT NULL,
  reasons            text[] NOT NULL,
  action             text NOT NULL,
  decided_at         timestamptz NOT NULL DEFAULT now(),
  p                  double precision CHECK (p BETWEEN 0 AND 1),
  PRIMARY KEY (loop_id, slot_end, algorithm_revision, input_revision)
) PARTITION BY RANGE (slot_end);
CREATE INDEX verdict_by_slot ON loopscope.verdict USING brin (slot_end);
