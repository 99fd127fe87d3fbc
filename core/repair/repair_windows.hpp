#pragma once

#include <optional>
#include <string>
#include <vector>

namespace loopscope::core::repair {

/// A parameter of an effect that the loop model found in a window, in the order of its steps.
struct EffectParameter {
  std::string effect;     ///< valve_stiction, sensor_hold, ... (core/model/results/explanation.hpp)
  std::string parameter;  ///< S, width, curvature, ...
  double value = 0.0;     ///< in the parameter's unit
};

/// What one analysed window says that a repair may change. Figures that a window does not have,
/// or that an earlier program did not compute, are empty.
struct RepairWindow {
  std::string code;    ///< of its verdict
  std::string family;  ///< faults that one repair removes (verdict catalogue); empty = no fault
  double confidence = 0.0;                      ///< of the verdict, 0 to 1
  std::optional<double> error_std;              ///< pv units
  std::optional<double> error_log_variance_se;  ///< standard error of ln(error_std^2)
  std::optional<double> harris;       ///< Harris index, 0 to 1, middle of plausible delays
  std::optional<double> ngi, nli;     ///< indices of the paper
  std::optional<double> nonlinear_p;  ///< 0 to 1
  bool oscillating = false;
  std::optional<double> oscillation_amplitude;  ///< pv units
  std::optional<double> valve_travel_per_h;     ///< %/h
  std::optional<double> controller_gain;        ///< %/pv, of a PI controller that fits; positive
  std::optional<double> integral_time_s;        ///< its integral time; positive
  std::vector<EffectParameter> effects;
};

/// The newest usable window after the work and before the next, which the comparison may not hold.
struct NewestWindow {
  std::string family;       ///< as RepairWindow::family
  double confidence = 0.0;  ///< 0 to 1
  std::string slot_end;     ///< in words, UTC
};

/// What lies about one piece of work: up to six windows on either side, which share no sample.
struct RepairWindows {
  std::vector<RepairWindow> before, after;
  /// Verdicts that are less sure than this say nothing of a fault, 0 to 1.
  double min_confidence = 0.0;
  std::string refused;  ///< why the newest window after the work is unusable; empty = none is
  std::optional<NewestWindow> newest;
};

}  // namespace loopscope::core::repair
