#pragma once

namespace loopscope::core::diagnosis {

/// How often each cause is to be expected, 0 to 1; 0 = as in the simulated loops that the curves
/// were fitted on (cause_curves.hpp names those shares). `nonlinear_unexplained`, any of several,
/// keeps its own.
struct Priors {
  double healthy = 0.0;
  double valve_stiction = 0.0;
  double valve_deadband = 0.0;
  double valve_saturation = 0.0;
  double valve_characteristic = 0.0;
  double valve_oversized = 0.0;
  double process_nonlinearity = 0.0;
  double external_disturbance = 0.0;
  double process_change = 0.0;
  double sensor_fault = 0.0;
  double tight_tuning = 0.0;
  double sluggish_tuning = 0.0;
};

/// How causes become a verdict.
struct DecisionSettings {
  double line = 0.3;  ///< least probability of a cause that is named, 0 to 1
  Priors priors;
};

/// @throws std::invalid_argument a probability is not from 0 to 1, or a prior is 1
void check(const DecisionSettings& settings);

}  // namespace loopscope::core::diagnosis
