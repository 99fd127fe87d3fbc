#pragma once

namespace loopscope::core::simulate {

/// PI settings in the paper's form (section 5.1).
struct ControllerSettings {
  double gain = 0.15;      ///< Kc, % of op per pv unit; negative for a reverse-acting process
  double integral = 0.15;  ///< I = Kc / tau_i, % of op per pv unit and sample
};

/// Kc + I / (1 - z^-1) in velocity form, held to 0 to 100 %: at a limit the integral stops
/// winding up, as in any plant controller.
class PiController {
 public:
  /// Starts with the output at `op_percent` and no error.
  PiController(const ControllerSettings& settings, double op_percent)
      : settings_(settings), op_percent_(op_percent) {}

  /// op in % for this sample's error sp - pv.
  double next(double error);

 private:
  ControllerSettings settings_;
  double op_percent_;
  double previous_error_ = 0.0;
};

}  // namespace loopscope::core::simulate
