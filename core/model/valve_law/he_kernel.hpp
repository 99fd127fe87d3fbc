#pragma once

#include <span>

#include "core/model/valve_law/valve_law.hpp"

namespace loopscope::core::model {

/// run_valves() of He's law, from an op[0] that is not NaN, in vectors as wide as the processor's;
/// the same on every kind of processor, to the last digit.
void run_he_valves(std::span<const Valve> valves, std::span<const double> op,
                   std::span<EightNumbers> mv);

}  // namespace loopscope::core::model
