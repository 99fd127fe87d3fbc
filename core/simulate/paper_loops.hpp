#pragma once

#include "core/simulate/loop.hpp"

namespace loopscope::core::simulate {

/// The loops of section 5: eq. 20, integrated white noise of 0.224, 6000 intervals of which the
/// last 4096 are kept.

/// 5.1: Kc = 0.15, I = 0.15.
[[nodiscard]] LoopSettings well_tuned_loop();

/// 5.2 as printed: I = 0.15 / 2.5 = 0.06, which is less integral action than in 5.1.
[[nodiscard]] LoopSettings printed_integral_loop();

/// 5.2 as its words say ("excessive"): I = 0.15 * 2.5 = 0.375, which is close to instability.
[[nodiscard]] LoopSettings excessive_integral_loop();

/// 5.3: 5.1 with a sinusoid of amplitude 2 and 0.01 cycles per sample on the process output.
[[nodiscard]] LoopSettings outside_sinusoid_loop();

/// 5.4: 5.1 with S = 3, J = 1 and a setpoint step at the start. The paper gives the step no size;
/// 10 is well above the 3 % * 2.25 = 6.75 that the stickband can hide.
[[nodiscard]] LoopSettings sticking_loop(StictionLaw law);

}  // namespace loopscope::core::simulate
