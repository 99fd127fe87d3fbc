#include "core/simulate/plant_loops.hpp"

namespace loopscope::core::simulate {

namespace {

LoopSettings recorded(const Recording& recording) {
  LoopSettings loop;
  loop.sample_interval_s = recording.sample_interval_s;
  loop.recorded_samples = recording.samples;
  loop.discarded_samples = 1000;
  return loop;
}

/// Gain 1.2, time constant 2 samples, dead time 2 samples; the controller closes the loop with a
/// time constant of 4 samples (lambda tuning: Kc = 2 / (1.2 (4 + 2)), I = Kc / 2).
LoopSettings flow_loop(const Recording& recording) {
  LoopSettings loop = recorded(recording);
  loop.process = {.delay_samples = 2, .b0 = 0.48, .b1 = 0.0, .pole = 0.6};
  loop.controller = {.gain = 0.27, .integral = 0.14};
  loop.load = {.step_std = 0.25, .memory = 0.98, .entry = LoadEntry::process_output};
  loop.measurement_noise_std = 0.2;
  return loop;
}

/// Gain 1.5, time constant 33 samples, dead time 4 samples, tuned for a time constant of 16.
LoopSettings temperature_loop(const Recording& recording) {
  LoopSettings loop = recorded(recording);
  loop.process = {.delay_samples = 4, .b0 = 0.045, .b1 = 0.0, .pole = 0.97};
  loop.controller = {.gain = 1.1, .integral = 0.033};
  loop.load = {.step_std = 0.06, .memory = 0.99, .entry = LoadEntry::process_output};
  loop.measurement_noise_std = 0.05;
  return loop;
}

/// An integrating vessel whose level moves by 0.02 per sample and % of flow; inflow wanders.
LoopSettings vessel_loop(const Recording& recording) {
  LoopSettings loop = recorded(recording);
  loop.process = {.delay_samples = 2, .b0 = 0.02, .b1 = 0.0, .pole = 1.0};
  loop.controller = {.gain = 4.0, .integral = 0.08};
  loop.load = {.step_std = 0.5, .memory = 0.98, .entry = LoadEntry::process_input};
  loop.measurement_noise_std = 0.05;
  return loop;
}

/// Up, back, down, back by `size`, one move every `every` samples.
std::vector<SetpointMove> moves(const LoopSettings& loop, double size, std::size_t every) {
  constexpr double kPattern[] = {1.0, -1.0, -1.0, 1.0};
  const std::size_t end = loop.discarded_samples + loop.recorded_samples;
  std::vector<SetpointMove> result;
  for (std::size_t at = every; at < end; at += every) {
    result.push_back({.at_sample = at, .size = size * kPattern[result.size() % 4]});
  }
  return result;
}

/// Seconds from the start of the record to a share of it.
double time_at(const LoopSettings& loop, double share) {
  return share * static_cast<double>(loop.recorded_samples) * loop.sample_interval_s;
}

}  // namespace

LoopSettings healthy_flow(const Recording& recording) {
  return flow_loop(recording);
}

LoopSettings tight_tuning(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.controller = {.gain = 0.1, .integral = 0.82};
  return loop;
}

LoopSettings sluggish_tuning(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.controller = {.gain = 0.05, .integral = 0.008};
  return loop;
}

LoopSettings sticking_valve(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.load.step_std = 0.1;
  loop.effects = {
      ValveStiction{.stickband_percent = 5.0, .slip_jump_percent = 2.0, .law = StictionLaw::kano}};
  return loop;
}

LoopSettings square_limit_cycle(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.controller = {.gain = 0.1, .integral = 0.06};
  loop.load.step_std = 0.05;
  // S = J: the valve jumps by the whole band and never slides, so mv is a square wave.
  loop.effects = {
      ValveStiction{.stickband_percent = 4.0, .slip_jump_percent = 4.0, .law = StictionLaw::kano}};
  return loop;
}

LoopSettings deadband(const Recording& recording) {
  LoopSettings loop = temperature_loop(recording);
  loop.controller = {.gain = 1.8, .integral = 0.1};
  loop.load.step_std = 0.02;
  loop.effects = {ValveDeadband{.width_percent = 4.0}};
  return loop;
}

LoopSettings oversized_valve(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  constexpr double kOversize = 12.0;
  loop.load.step_std = 0.1;
  loop.process.b0 *= kOversize;
  loop.controller.gain /= kOversize;
  loop.controller.integral /= kOversize;
  // A valve this large works near its resolution: it moves in steps of tenths of a percent.
  loop.effects = {
      ValveStiction{.stickband_percent = 0.3, .slip_jump_percent = 0.2, .law = StictionLaw::kano}};
  return loop;
}

LoopSettings saturated_valve(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.load = {.step_std = 0.35, .memory = 0.998, .entry = LoadEntry::process_output};
  loop.effects = {ValveSaturation{.low_percent = 20.0, .high_percent = 53.0}};
  return loop;
}

LoopSettings worn_valve(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.effects = {ValveCharacteristic{.curvature = 0.45}};
  loop.setpoint_moves = moves(loop, 20.0, 250);
  return loop;
}

LoopSettings nonlinear_process(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.effects = {ProcessNonlinearity{.curvature = 0.8}};
  loop.setpoint_moves = moves(loop, 15.0, 250);
  return loop;
}

LoopSettings process_gain_change(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.setpoint_moves = moves(loop, 5.0, 300);
  loop.effects = {GainChange{.at_s = time_at(loop, 0.5), .ratio = 2.5}};
  return loop;
}

LoopSettings outside_oscillation(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.effects = {ExternalOscillation{.period_s = 60.0 * loop.sample_interval_s, .amplitude = 3.0}};
  return loop;
}

LoopSettings load_upsets(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.effects = {LoadStep{.at_s = time_at(loop, 0.2), .size = 12.0},
                  LoadStep{.at_s = time_at(loop, 0.45), .size = -20.0},
                  LoadStep{.at_s = time_at(loop, 0.7), .size = 15.0}};
  return loop;
}

LoopSettings quantised_sensor(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.effects = {SensorQuantisation{.step = 1.0}};
  return loop;
}

LoopSettings holding_sensor(const Recording& recording) {
  LoopSettings loop = flow_loop(recording);
  loop.controller = {.gain = 0.05, .integral = 0.02};
  loop.effects = {SensorHold{.samples = 12.0}};
  return loop;
}

LoopSettings level_loop(const Recording& recording) {
  return vessel_loop(recording);
}

LoopSettings sticking_level(const Recording& recording) {
  LoopSettings loop = vessel_loop(recording);
  loop.controller = {.gain = 4.0, .integral = 0.3};
  loop.load.step_std = 0.1;
  loop.effects = {
      ValveStiction{.stickband_percent = 4.0, .slip_jump_percent = 2.0, .law = StictionLaw::kano}};
  return loop;
}

}  // namespace loopscope::core::simulate
