#pragma once

#include <cmath>

namespace loopscope::tests::generators {

/// Friction in % of op: the stem moves off at an imbalance of `static_friction` and slides against
/// `kinetic_friction`. S = static + kinetic, J = static - kinetic.
struct Friction {
  double static_friction = 1.0;
  double kinetic_friction = 0.5;
};

/// Of a stick band S and a slip jump J.
[[nodiscard]] inline Friction friction_of(double band, double jump) {
  return {(band + jump) / 2.0, (band - jump) / 2.0};
}

/// Where the stem of He, Wang, Pottmann, Qin (2007) stands next: still, or, once the pressure
/// overcomes the static friction, where the kinetic friction balances it.
[[nodiscard]] inline double slipped(double stem, double pressure, Friction friction) {
  const double imbalance = pressure - stem;
  if (std::abs(imbalance) <= friction.static_friction) return stem;
  return pressure - std::copysign(friction.kinetic_friction, imbalance);
}

}  // namespace loopscope::tests::generators
