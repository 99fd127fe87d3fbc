#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/plants/process/process_plant.hpp"
#include "tests/plants/process/unit_process.hpp"

namespace loopscope::tests::process {

/// How a valve follows its actuator; sizes in % of travel.
enum class Friction {
  play,      ///< follows after `play`
  jump,      ///< two parameters, as He et al. (2007): sticks at `stick`, lags by `slide`
  stribeck,  ///< Karnopp (1985) without inertia: breaks away at `stick`, slides at `slide`
};

struct ValvePlan {
  Friction friction = Friction::play;
  double play = 0.0;
  double stick = 0.0;
  double slide = 0.0;  ///< at most stick
  double actuator_lag_s = 2.0;
};

/// What flows through one valve, in the process's units.
struct StreamPlan {
  double nominal = 1.0;
  double full = 2.0;  ///< with the valve open and nominal supply
  double hydraulic_lag_s = 2.0;
  std::optional<std::size_t> supply;  ///< the upset by whose fraction the flow rises
  ValvePlan valve;
};

/// A wave from outside: a sinusoid whose phase wanders and whose amplitude comes and goes.
struct WavePlan {
  double period_s = 600.0;
  double amplitude = 0.0;  ///< 0 = there is none
  double wander = 0.0;     ///< radians of phase after one period
  double second = 0.0;     ///< share of a second harmonic
};

/// What a supply does by itself: filtered noise about its nominal value.
struct UpsetPlan {
  double typical = 0.0;  ///< a usual standard deviation, in the process's units
  double sd = 0.0;
  double memory_s = 600.0;
  bool smooth = false;  ///< filtered twice
  WavePlan wave;
};

/// A sensor that drifts and is set right again.
struct SawtoothPlan {
  double size = 0.0;  ///< in the pv's units, signed; 0 = a sound sensor
  double period_s = 600.0;
  double wander = 0.1;  ///< standard deviation of one period by the mean
  double bend = 1.0;    ///< power of the drift's shape
};

struct LoopPlan {
  std::string name, type;
  bool integrating = false;
  std::optional<std::size_t> flow_of;  ///< the stream that is measured
  std::size_t value = 0;               ///< else the process's value
  double low = 0.0, high = 100.0;      ///< span of the sensor
  double sp0 = 50.0;
  std::optional<std::size_t> valve;   ///< the stream that it moves; else it is a master
  std::optional<std::size_t> master;  ///< whose output is the setpoint, 0 to 100 % of the span
  std::optional<std::size_t> ratio_to;
  double ratio = 1.0;
  double gain = 1.0;  ///< % by %, signed: positive = output rises with sp - pv
  double integral_time_s = 60.0;
  double op0 = 50.0, op_low = 0.0, op_high = 100.0;
  long scan_steps = 1;
  double sensor_lag_s = 0.0, dead_time_s = 0.0;
  double noise_sd = 0.0, quantum = 0.0;
  double sp_moves_s = 0.0;  ///< mean time between steps of the setpoint; 0 = at rest
  double sp_size = 0.0;
  SawtoothPlan sawtooth;
};

struct PlantPlan {
  PlantKind kind = PlantKind::evaporator;
  double step_s = 1.0;
  double settle_s = 7200.0;  ///< run before anything is recorded
  std::vector<StreamPlan> streams;
  std::vector<LoopPlan> loops;
  std::vector<UpsetPlan> upsets;
  std::function<std::unique_ptr<UnitProcess>()> process;
  std::uint64_t noise_seed = 0;
};

}  // namespace loopscope::tests::process
