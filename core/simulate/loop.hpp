#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/simulate/effect.hpp"
#include "core/simulate/process.hpp"

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

/// Where the wandering load, the oscillations and the load steps enter.
enum class LoadEntry {
  process_output,  ///< as in the paper
  process_input,   ///< as a flow into a vessel, in % of flow
};

/// d(k) = memory d(k-1) + step_std w(k), w standard normal.
struct WanderingLoad {
  double step_std = 0.224;  ///< pv units (or % of flow), >= 0; the paper's figure
  double memory = 1.0;      ///< 0 to 1; 1 = integrated white noise, as in the paper
  LoadEntry entry = LoadEntry::process_output;
};

/// A change of the setpoint, at a sample counted from the start of the simulation.
struct SetpointMove {
  std::size_t at_sample = 0;
  double size = 0.0;  ///< pv units
};

/// The loop of section 5 around the operating point setpoint = 50 pv units, op = mv = flow = 50 %.
struct LoopSettings {
  ProcessModel process;
  ControllerSettings controller;
  WanderingLoad load;
  double measurement_noise_std = 0.0;  ///< pv units, white, seen by the controller
  std::vector<SetpointMove> setpoint_moves;
  std::vector<Effect> effects;           ///< applied in physical order, whatever their order here
  double sample_interval_s = 1.0;        ///< > 0
  std::size_t discarded_samples = 1904;  ///< of the paper's 6000 intervals, before the record
  std::size_t recorded_samples = 4096;   ///< the last of them, which the paper analyses
};

/// What the loop's historian would hold. Equal lengths.
struct LoopRecord {
  double sample_interval_s = 1.0;
  std::vector<double> sp;  ///< setpoint, pv units
  std::vector<double> pv;  ///< as measured, pv units
  std::vector<double> op;  ///< controller output, 0 to 100 %
  std::vector<double> mv;  ///< valve position, 0 to 100 %
};

/// Setpoint and controller output that everything is a distance from.
inline constexpr double kOperatingPoint = 50.0;

/// Runs the loop. The same settings and seed give the same record, bit for bit, on machines whose
/// mathematical library agrees. Throws std::invalid_argument for settings out of range.
[[nodiscard]] LoopRecord simulate_loop(const LoopSettings& settings, std::uint64_t seed);

/// sp - pv, the signal that the paper analyses.
[[nodiscard]] std::vector<double> control_error(const LoopRecord& record);

}  // namespace loopscope::core::simulate
