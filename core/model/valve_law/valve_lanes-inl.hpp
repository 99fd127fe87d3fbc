// Compiled once for each kind of processor: number_pair.hpp.
#if defined(LOOPSCOPE_MODEL_VALVE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOOPSCOPE_MODEL_VALVE_LANES_INL
#undef LOOPSCOPE_MODEL_VALVE_LANES_INL
#else
#define LOOPSCOPE_MODEL_VALVE_LANES_INL
#endif

#include <array>
#include <cstddef>
#include <hwy/highway.h>

#include "core/model/valve_law/valve_law.hpp"
#include "core/model/vectors/number_pair.hpp"

HWY_BEFORE_NAMESPACE();
namespace loopscope::core::model {
inline namespace HWY_NAMESPACE {

/// Half widths: where the resting valve breaks loose, and how far a moving one lags behind op. Of
/// one valve (an Element), or of as many as a Number has (see put()).
template <typename Element>
struct alignas(sizeof(Element)) FrictionIn {
  FrictionIn() = default;
  explicit FrictionIn(const Valve& valve)
      : band(static_cast<Element>(valve.stickband_percent)),
        jump(static_cast<Element>(valve.slip_jump_percent)),
        breakaway(static_cast<Element>(0.5 * (valve.stickband_percent + valve.slip_jump_percent))),
        lag(static_cast<Element>(0.5 * (valve.stickband_percent - valve.slip_jump_percent))) {}
  Element band{};
  Element jump{};
  Element breakaway{};
  Element lag{};
};
using Friction = FrictionIn<double>;

/// Some valves of one law, side by side under the same op: they differ in where they are, and in
/// their friction where step() is given one FrictionIn<Number> for each Number instead of one for
/// all. Number is double, NumberPair or ShortNumbers, and there are `count` of them. Choices only,
/// no branches.
template <typename Number, std::size_t count>
struct ValveLanes {
  using Element = typename ElementOf<Number>::type;
  using Friction = FrictionIn<Element>;
  using Mask = MaskOf<Number>;
  using Numbers = NumberRow<Number, count>;
  using Frictions = std::array<FrictionIn<Number>, count>;
  Numbers position{};
  Numbers turn{};                   ///< choudhury: op where counting starts
  NumberRow<Mask, count> moving{};  ///< choudhury, kano

  /// All at rest at `op` after a motion in that direction.
  void start(const Friction& friction, Element direction, Element op) {
    position.fill(all(op - direction * friction.lag));
    turn.fill(all(op));
  }

  /// Puts a valve with a friction of its own into one lane, before the first op.
  void put_in(std::size_t lane, const Valve& valve, Element op, Frictions& frictions) {
    const std::size_t v = lane / kElements<Number>, i = lane % kElements<Number>;
    const FrictionIn<Element> friction(valve);
    frictions[v].band[i] = friction.band;
    frictions[v].jump[i] = friction.jump;
    frictions[v].breakaway[i] = friction.breakaway;
    frictions[v].lag[i] = friction.lag;
    position[v][i] = valve.start_percent
                         ? static_cast<Element>(*valve.start_percent)
                         : op - static_cast<Element>(valve.start_direction) * friction.lag;
    turn[v][i] = op;
  }

  template <ValveLaw law, typename OneOrMany>
  void step(const OneOrMany& friction, const OpStep<Element>& step) {
    if constexpr (law == ValveLaw::he) {
      step_he(friction, step.op);
    } else {
      step_with_op<law>(friction, step);
    }
  }

 private:
  static Number all(Element value) { return Number{} + value; }
  static const Friction& of(const Friction& friction, std::size_t) { return friction; }
  static const FrictionIn<Number>& of(const Frictions& frictions, std::size_t i) {
    return frictions[i];
  }

  template <typename OneOrMany>
  void step_he(const OneOrMany& frictions, Element op) {
    const Number now = all(op);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& friction = of(frictions, i);
      // The next sample waits for the place, so the way to it is kept short: both thresholds are
      // asked at once, and where to is known meanwhile.
      const Number gap = now - position[i];
      const Number behind = now - friction.lag;
      const Number ahead = now + friction.lag;
      const Number target = gap > Number{} ? behind : ahead;
      const Mask loose = Mask((gap > friction.breakaway) | (gap < -friction.breakaway));
      position[i] = loose ? target : position[i];
    }
  }

  template <ValveLaw law, typename OneOrMany>
  void step_with_op(const OneOrMany& frictions, const OpStep<Element>& step) {
    const Number now = all(step.op);
    const Number before = all(step.before);
    const Mask kept = all(step.kept) > Number{};
    const Mask stopped = all(step.kept) == Number{};
    const Mask turned = all(step.turned) > Number{};
    for (std::size_t i = 0; i < count; ++i) {
      const auto& friction = of(frictions, i);
      const Number slide = now - step.direction * friction.lag;
      const Number reach =
          Number{} + (law == ValveLaw::choudhury ? friction.band : friction.breakaway);
      Number from = position[i];
      if constexpr (law == ValveLaw::choudhury) {
        turn[i] = Mask(turned | (stopped & moving[i])) ? before : turn[i];
        from = turn[i];
      }
      // A valve of Kano's law that stopped after a motion stands (S + J) / 2 off both of its
      // thresholds, J ahead and S back: so they are asked like He's.
      const Number way = now - from;
      moving[i] = Mask((way > reach) | (way < -reach) | (kept & moving[i]));
      position[i] = moving[i] ? slide : position[i];
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace loopscope::core::model
HWY_AFTER_NAMESPACE();

#endif  // LOOPSCOPE_MODEL_VALVE_LANES_INL
