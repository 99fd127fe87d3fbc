#pragma once

#include <cmath>

#include "tests/effects/load_model.hpp"
#include "tests/effects/valve.hpp"
#include "tests/generators/lag.hpp"

namespace loopscope::tests::effects {

using generators::Lag;

/// Told its target once a substep.
[[nodiscard]] inline Lag lag_of(Actuator actuator) {
  return Lag(1.0 - std::exp(-1.0 / (kSubsteps * actuator.lag)), actuator.start);
}

}  // namespace loopscope::tests::effects
