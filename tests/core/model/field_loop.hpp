#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/simulate/random.hpp"

namespace loopscope::tests::model {

/// Random numbers of one simulated recording.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : normal_(seed), uniform_(~seed) {}
  double normal() { return normal_.next(); }
  double between(double low, double high) { return low + (high - low) * uniform_.next(); }
  double log_between(double low, double high);
  bool chance(double probability) { return uniform_.next() < probability; }
  std::size_t whole(std::size_t low, std::size_t high);  ///< low and high included

 private:
  core::simulate::GaussianSource normal_;
  core::simulate::UniformSource uniform_;
};

/// Of a sensor: normal, Student's t of five degrees of freedom, or normal and four times as loud
/// for stretches of fifty steps on average, a fifth of the time.
enum class NoiseKind { normal, t5, bursts };

enum class Friction { none, he, karnopp };

/// The valve: friction in % of op; S = static + dynamic, J = static - dynamic.
struct FieldValve {
  Friction friction = Friction::none;
  double stickband_percent = 0.0;
  double slip_jump_percent = 0.0;
  double asymmetry = 0.0;  ///< share by which friction is larger on the way up
  double spread = 0.0;     ///< of ln(friction) from one stroke to the next: packing is not even
  /// Friction comes and goes: there for so many steps, away for as many; 0 = always there.
  std::size_t stretch_steps = 0;
};

/// A wave from outside.
struct OutsideWave {
  enum class Shape { sine, square, triangle, lopsided };
  Shape shape = Shape::sine;
  double period_steps = 100.0;
  double amplitude = 0.0;   ///< pv units at the output, % of flow at the input
  double phase_walk = 0.0;  ///< radians per root step
  double fading = 0.0;      ///< std of the amplitude's slow wandering, share of it
  bool at_input = false;    ///< passes the process like a flow
};

/// What the sensor, the analyser and the historian do to pv (op is rounded by the historian too).
struct Recording {
  double pv_grid = 0.0;           ///< pv units, sensor's, seen by the controller
  std::size_t sensor_hold = 1;    ///< steps between analyser results
  double sensor_dead_zone = 0.0;  ///< pv units within which the reading stays
  double sensor_wander = 0.0;     ///< std of a slow faulty reading (AR), pv units
  double spike_rate = 0.0;        ///< per step
  double archive_band_pv = 0.0;   ///< dead band of the archive, pv units
  double archive_band_op = 0.0;   ///< % of op
  double archive_grid_pv = 0.0;
  double archive_grid_op = 0.0;
  bool pv_late = false;      ///< op is recorded a step before the pv beside it
  bool interpolate = false;  ///< archive joins its points by lines (else holds them)
  std::size_t every = 1;     ///< steps between recorded samples
  bool means = false;        ///< of pv and op over these steps are recorded, not the last values
};

struct FieldSettings {
  bool integrating = false;
  double gain = 1.0;       ///< pv units per % (integrating: and step)
  double lag_steps = 3.0;  ///< first order
  double second_lag_steps = 0.0;
  double actuator_lag_steps = 0.0;  ///< of the air that moves the stem, before the friction
  double filter_steps = 0.0;        ///< of the transmitter
  double trim = 0.0;                ///< curvature of flow over the stem: flow = x (1 + trim x / 50)
  std::size_t dead_steps = 1;
  double controller_gain = 0.3;  ///< % per pv unit, sign of `gain`
  double integral_steps = 10.0;
  double op_low = 0.0, op_high = 100.0;
  std::size_t controller_every = 1;  ///< steps from one move of op to the next
  double op_step = 0.0;              ///< % by which op moves at least: a stepping output; 0 = any
  FieldValve valve;
  std::vector<OutsideWave> waves;
  std::vector<double> neighbour;  ///< what another loop adds to pv, step by step; again and again
  double noise_std = 0.0;         ///< white, pv units
  NoiseKind noise = NoiseKind::normal;
  double load_step_std = 0.0;  ///< AR load at the input, % of flow per step
  double load_memory = 0.999;
  double load_lag_steps = 0.0;     ///< of what the load passes before it reaches the process
  double setpoint_step_std = 0.0;  ///< size of moves, pv units
  double setpoint_every = 0.0;     ///< mean steps between them; 0 = none
  OutsideWave master;              ///< set point moved by a master (cascade); amplitude 0 = none
  double master_walk = 0.0;        ///< std of the set point's AR part
  Recording recording;
};

struct FieldLoop {
  std::vector<double> sp, pv, op;
  std::vector<double> mv;  ///< the truth, not recorded by the plant
};

/// `samples` recorded samples after 800 steps of running in.
[[nodiscard]] FieldLoop run_field_loop(const FieldSettings& settings, std::size_t samples,
                                       Draw& draw);

}  // namespace loopscope::tests::model
