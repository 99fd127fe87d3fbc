#pragma once

#include <memory>
#include <vector>

#include "tests/generators/friction.hpp"

namespace loopscope::tests::effects {

/// A control valve from op to stem position, both in %; one call per substep of the simulation.
class Valve {
 public:
  Valve() = default;
  Valve(const Valve&) = delete;
  Valve& operator=(const Valve&) = delete;
  virtual ~Valve() = default;
  [[nodiscard]] virtual double step(double op) = 0;
};

using generators::Friction;

/// Every actuator lags behind op with a time constant of `lag` samples, 0 < lag; starts at rest at
/// `start`.
struct Actuator {
  double lag = 0.1;
  double start = 50.0;
};

/// He, Wang, Pottmann, Qin (2007): slips by J and sticks again at once, on the substep.
[[nodiscard]] std::unique_ptr<Valve> make_he_valve(Friction friction, Actuator actuator);

/// Karnopp (1985): mass, spring, viscous and Coulomb friction, a velocity below which the stem is
/// at rest. `response` = time constant of the sliding stem in samples.
[[nodiscard]] std::unique_ptr<Valve> make_karnopp_valve(Friction friction, Actuator actuator,
                                                        double response);

/// Karnopp's valve, or He's, which needs no response.
[[nodiscard]] std::unique_ptr<Valve> make_sticking_valve(bool karnopp, Friction friction,
                                                         Actuator actuator, double response);

/// Play between stem and plug; friction of the load holds the plug inside the play, and it closes
/// up to the edge with a time constant of `response` samples. `width` = full width.
[[nodiscard]] std::unique_ptr<Valve> make_backlash_valve(double width, Actuator actuator,
                                                         double response);

/// Stem stops whose last 1 % squeezes.
[[nodiscard]] std::unique_ptr<Valve> make_stop_valve(double low, double high, Actuator actuator);

/// Sticks as He's valve in the stretches between the odd and even times (samples since the start
/// of the simulation, ascending), else follows.
[[nodiscard]] std::unique_ptr<Valve> make_intermittent_valve(Friction friction, Actuator actuator,
                                                             std::vector<double> switches);

/// A positioner that overshoots its target to and fro at one speed: a triangle of `amplitude` and
/// `period` samples about op, bent when op moves.
[[nodiscard]] std::unique_ptr<Valve> make_hunting_valve(double amplitude, double period,
                                                        Actuator actuator);

}  // namespace loopscope::tests::effects
