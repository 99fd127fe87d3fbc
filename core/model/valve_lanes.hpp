#pragma once

#include <array>
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

/// Two numbers that every processor adds, compares and chooses (`condition ? a : b`) as one: what
/// compilers make of longer ones and of loops over lanes is slower than plain code.
typedef double NumberPair __attribute__((vector_size(2 * sizeof(double))));

/// Some valves of one law, side by side under the same op: they differ in where they are. Number is
/// double or NumberPair, and there are `count` of them. Choices only, no branches.
template <typename Number, std::size_t count>
struct ValveLanes {
  using Numbers = std::array<Number, count>;
  Numbers position{};
  Numbers turn{};    ///< choudhury: op where counting starts
  Numbers moving{};  ///< choudhury, kano: 0 or 1
  OpMotion motion;

  /// All at rest at `op` after a motion in that direction.
  void start(const Friction& friction, double direction, double op) {
    position.fill(Number{} + (op - direction * friction.lag));
    turn.fill(Number{} + op);
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
    const Number behind = Number{} + (op - friction.lag);
    const Number ahead = Number{} + (op + friction.lag);
    for (Number& place : position) {
      // Both thresholds are asked of the same old position: the two choices need not wait for
      // each other.
      const Number gap = op - place;
      const Number up = gap > friction.breakaway ? behind : place;
      place = gap < -friction.breakaway ? ahead : up;
    }
  }

  template <ValveLaw law>
  void step_with_op(const Friction& friction, double op) {
    const Number slide = Number{} + (op - motion.direction * friction.lag);
    const Number before = Number{} + motion.previous;
    const Number one = Number{} + 1.0;
    const double kept = motion.stopped ? 0.0 : 1.0;
    const double rebased = motion.turned ? 1.0 : 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      double reach = friction.breakaway;
      Number from = position[i];
      if constexpr (law == ValveLaw::choudhury) {
        turn[i] = rebased + (1.0 - kept) * moving[i] > 0.5 ? before : turn[i];
        reach = friction.band;
        from = turn[i];
      }
      // A valve of Kano's law that stopped after a motion stands (S + J) / 2 off both of its
      // thresholds, J ahead and S back: so they are asked like He's.
      const Number way = op - from;
      const Number up = way > reach ? one : kept * moving[i];
      moving[i] = way < -reach ? one : up;
      position[i] = moving[i] > 0.5 ? slide : position[i];
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
