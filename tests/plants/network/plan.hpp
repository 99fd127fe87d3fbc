#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/effects/valve.hpp"
#include "tests/plants/network/parts.hpp"

namespace loopscope::tests::network {

/// Seconds between two steps of the simulation.
inline constexpr double kStep_s = 0.2;

enum class LoopKind { flow, pressure, level, temperature };

/// One loop of a plant; everything but op and the valve is a distance from (op0, pv0), in % of
/// span.
struct LoopPlan {
  std::string name;
  LoopKind kind = LoopKind::flow;
  std::size_t unit = 0;
  Process process;
  Controller controller;
  double op0 = 50.0;
  double noise_sd = 0.0;      ///< white, of the sensor
  double load_sd = 0.0;       ///< of a wandering load at the process's input
  double load_tau_s = 100.0;  ///< its memory
  double quantum = 0.0;       ///< the sensor rounds to multiples of this; 0 = it does not
  double sp_moves_s = 0.0;    ///< mean time between setpoint steps; 0 = at rest
  double sp_size = 0.0;
  double interval_s = 1.0;            ///< of the historian
  double end_early_s = 0.0;           ///< its window ends so much before the last one
  std::optional<std::size_t> master;  ///< whose output writes the setpoint
  double master_gain = 1.0;           ///< setpoint by % of the master's output
  std::function<std::unique_ptr<effects::Valve>()> valve;  ///< empty = follows at once
};

/// What one loop does to another.
struct Stream {
  std::size_t from = 0;
  std::size_t to = 0;
  bool carries_pv = false;  ///< pv of `from`; else the flow through its valve
  double gain = 0.0;        ///< joins the flow of `to`
  double lag_s = 0.0;
  double delay_s = 0.0;
};

/// An oscillation from outside the plant.
struct Outside {
  double period_s = 0.0;
  double amplitude = 0.0;          ///< % of flow; 0 = there is none
  double wander = 0.0;             ///< of its phase, radians after one period
  double third = 0.0;              ///< share of a third harmonic
  std::vector<std::size_t> loops;  ///< that it reaches first
  std::vector<double> gains;
};

struct PlantPlan {
  std::vector<LoopPlan> loops;
  std::vector<Stream> streams;
  Outside outside;
  std::uint64_t noise_seed = 0;
};

}  // namespace loopscope::tests::network
