#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace loopscope::core::model {

/// The closed list of effects that a loop model can take in; name() of effects/effect_catalogue.hpp
/// gives the word that users, scripts and the results schema see.
enum class EffectKind {
  valve_stiction,
  valve_deadband,
  valve_saturation,
  valve_characteristic,
  process_nonlinearity,
  external_oscillation,
  load_step,
  gain_change,
  sensor_quantisation,
  sensor_hold,
};

/// What the errors of an explanation are the mean squares of, pv units squared, on samples that
/// the fit has not seen.
enum class ErrorKind {
  one_step,    ///< prediction of the next sample, the noise model included
  simulation,  ///< the model run on op alone, with offset and slow drift
};
[[nodiscard]] std::string_view name(ErrorKind kind);

/// A fitted figure and how sure it is.
struct Parameter {
  std::string_view name;  ///< the word of the results, e.g. "S", "period_s"
  std::string_view unit;  ///< "%", "s", "pv", "" = a ratio
  double value = 0.0;
  std::optional<double> low;   ///< 90 % interval
  std::optional<double> high;  ///< 90 % interval
};

/// A residual test that asked for an effect.
struct AskedBy {
  std::string_view test;          ///< e.g. "op_direction"
  double p = 1.0;                 ///< of the residual before the effect
  std::optional<double> p_after;  ///< of that after it; nullopt = not asked again
  std::string statement;          ///< what it saw, with figures
};

/// What a residual test asked for, whether it was taken in or not.
struct AskedEffect {
  EffectKind effect = EffectKind::valve_stiction;
  std::string_view test;
  double p = 1.0;  ///< of the part of the test that points to this effect
};

/// One effect that the model took in.
struct Step {
  EffectKind effect = EffectKind::valve_stiction;
  std::vector<Parameter> parameters;
  std::string_view law;  ///< of valve_stiction: choudhury, kano, he; empty = the effect has one law
  double holdout_error_before = 0.0;  ///< of Explanation::error_kind
  double holdout_error_after = 0.0;
  double evidence = 0.0;  ///< n ln(before / after) over the n held-out samples
  double p = 1.0;         ///< that an effect which is not there lowers the held-out error so far
  double margin = 0.0;    ///< evidence less that of the best rival of another verdict, or less what
                          ///< one promised that was not tried
  /// Mean square of the simulation error after the step by that before it; nullopt = not computed.
  std::optional<double> simulation_ratio;
  double steadiness = 1.0;  ///< share, 0 to 1, of the record's parts in which it lowers the error
  /// Of a valve: the loop cycles, but not about this band (cycle_valve.hpp).
  bool cycle_contradicts_valve = false;
  /// Of play: the loop keeps up a cycle about this band, as behind a valve that sticks.
  bool cycle_indicates_stiction = false;
  /// Of a load step that comes when the loop answers its setpoint: the chance that loads at any
  /// time do so (steps_after_moves.hpp). 1 = it comes at another time.
  double setpoint_chance = 1.0;
  std::string statement;  ///< one sentence with the figures, for an engineer
  /// The residual tests that asked for it, the most significant first; empty = none did, and the
  /// cheap look that every effect gets showed it.
  std::vector<AskedBy> asked_by;
  /// Its place among the effects that the tests asked for, by p; 1 = the most promising, 0 = none
  /// asked for it.
  std::size_t promise_rank = 0;
};

/// The process between valve and sensor, as the final model has it.
struct ProcessFit {
  bool integrating = false;
  double gain = 0.0;             ///< pv units per %; integrating: pv units per % and second
  double time_constant_s = 0.0;  ///< the slowest; 0 = answers within a sample, or integrating
  double second_time_constant_s = 0.0;  ///< 0 = first order; integrating: lag beside the integrator
  double delay_s = 0.0;                 ///< at least one sample interval
};

/// ln(before / after) of the held-out error: what one step explains, in the measure in which the
/// steps of an explanation add up. 0 for a step that does not lower the error (the grid of a coarse
/// sensor need not) and for errors that are no positive numbers.
[[nodiscard]] double explained_by(const Step& step);

struct Baseline {
  std::string description;     ///< one line: order, gain, time constants, delay, noise
  double holdout_error = 0.0;  ///< of the linear model
  ProcessFit process;
};

/// One question put to what the model leaves.
struct Question {
  std::string_view name;  ///< e.g. "white", "op_direction", "periodic"
  double p = 1.0;         ///< under "nothing there"
  std::string statement;  ///< what was found, with figures; empty when nothing was
};

/// What the model cannot explain.
struct Unexplained {
  double fraction = 0.0;  ///< of what could be explained, 0 to 1 (explain.hpp)
  double whiteness_p = 1.0;
  std::optional<double> ngi_p;  ///< of the final residual
  std::string statement;
};

/// The controller as the records of error and op show it, and the closed loop it makes with the
/// fitted process.
struct ClosedLoop {
  double controller_gain = 0.0;   ///< % per pv unit, signed
  double integral_time_s = 0.0;   ///< 0 = no integral action found
  double controller_fit = 0.0;    ///< share of op's moves that the PI law explains, 0 to 1
  double peak_sensitivity = 0.0;  ///< Ms, >= 1; infinite when the implied loop is unstable
  double damping = 1.0;           ///< of the dominant poles, -1 to 1; negative = unstable
  double period_s = 0.0;          ///< of the dominant poles; 0 = they do not oscillate
  double settling_s = 0.0;        ///< 2 % of the slowest pole; infinite when unstable
  double slowness = 1.0;  ///< integral action of SIMC tuning by the recorded one; 0 = none recorded
  /// Integral action, % per pv unit and second, signed; 0 = none found. Gain by integral time is
  /// not where the gain is next to nothing.
  double integral_per_s = 0.0;
};

/// The explanation of one loop, from the linear model to what is left.
struct Explanation {
  bool excited = false;       ///< op moves enough for claims; else nothing below claims anything
  std::string excitation;     ///< why not, or how much op moves
  std::string process_doubt;  ///< the linear fit may be the controller run backwards; empty = no
  ErrorKind error_kind = ErrorKind::one_step;
  double noise_floor = 0.0;  ///< what a perfect model would leave, same kind as the errors
  Baseline baseline;
  std::vector<Step> steps;         ///< in the order in which they were taken in
  std::vector<AskedEffect> asked;  ///< of the linear loop's residual, the most promising first
  Unexplained unexplained;
  std::vector<Question> questions;        ///< put to the final residual
  std::optional<ClosedLoop> closed_loop;  ///< nullopt = no PI law found
};

}  // namespace loopscope::core::model
