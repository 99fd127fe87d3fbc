#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/model/valve_law.hpp"

namespace loopscope::core::model {

/// Half widths: where the resting valve breaks loose, and how far a moving one lags behind op.
struct Friction {
  explicit Friction(const Valve& valve)
      : band(valve.stickband_percent),
        breakaway(0.5 * (valve.stickband_percent + valve.slip_jump_percent)),
        lag(0.5 * (valve.stickband_percent - valve.slip_jump_percent)) {}
  double band;
  double breakaway;
  double lag;
};

/// What op does, the same for every valve that sees it.
struct OpMotion {
  double previous = 0.0;
  double direction = 1.0;  ///< of op's last motion
  bool stood_still = true;
  bool turned = false;
  bool stopped = false;  ///< turned, or stood still for the second time

  void take(double op) {
    const double slope = op - previous;
    const bool still = slope == 0.0;
    turned = slope * direction < 0.0;
    stopped = turned || (still && stood_still);
    direction = turned ? -direction : direction;
    stood_still = still;
  }
};

/// Some valves of one law, side by side under the same op: they differ in where they are. Loops
/// over lanes hold choices only, no branches, so that compilers turn them into vectors; moving is
/// 0 or 1 for that reason.
template <std::size_t lanes>
struct ValveLanes {
  std::array<double, lanes> position{};
  std::array<double, lanes> turn{};    ///< choudhury: op where counting starts
  std::array<double, lanes> moving{};  ///< choudhury, kano
  OpMotion motion;

  /// All at rest at `op` after a motion in that direction.
  void start(const Friction& friction, double direction, double op) {
    position.fill(op - direction * friction.lag);
    turn.fill(op);
    motion.previous = op;
    motion.direction = direction;
  }

  template <ValveLaw law>
  void step(const Friction& friction, double op) {
    if constexpr (law == ValveLaw::he) {
      step_he(friction, op);
    } else {
      motion.take(op);
      step_with_op<law>(friction, op);
    }
    motion.previous = op;
  }

 private:
  void step_he(const Friction& friction, double op) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      // Both thresholds are asked of the same old position: the two choices need not wait for
      // each other.
      const double gap = op - position[lane];
      const double up = gap > friction.breakaway ? op - friction.lag : position[lane];
      position[lane] = gap < -friction.breakaway ? op + friction.lag : up;
    }
  }

  template <ValveLaw law>
  void step_with_op(const Friction& friction, double op) {
    const double slide = op - motion.direction * friction.lag;
    const double kept = motion.stopped ? 0.0 : 1.0;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if constexpr (law == ValveLaw::choudhury) {
        const double rebase = motion.turned ? 1.0 : (1.0 - kept) * moving[lane];
        turn[lane] = rebase > 0.5 ? motion.previous : turn[lane];
      }
      // A valve of Kano's law that stopped after a motion stands (S + J) / 2 off both of its
      // thresholds, J ahead and S back: so they are asked like He's.
      const bool loose = law == ValveLaw::choudhury
                             ? std::abs(op - turn[lane]) > friction.band
                             : std::abs(op - position[lane]) > friction.breakaway;
      moving[lane] = loose ? 1.0 : kept * moving[lane];
      position[lane] = moving[lane] > 0.5 ? slide : position[lane];
    }
  }
};

/// Calls f with the law as a constant of the compiler: f.template operator()<law>().
template <typename Function>
void with_law(ValveLaw law, Function&& f) {
  switch (law) {
    case ValveLaw::choudhury:
      return f.template operator()<ValveLaw::choudhury>();
    case ValveLaw::kano:
      return f.template operator()<ValveLaw::kano>();
    case ValveLaw::he:
      return f.template operator()<ValveLaw::he>();
  }
}

}  // namespace loopscope::core::model
