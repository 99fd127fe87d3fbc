#pragma once

#include <span>

#include "core/model/valve_law/valve_law.hpp"

namespace loopscope::core::model {

/// run_valves() from an op[0] that is not NaN, in vectors of the processor; the same on every kind
/// of processor, to the last digit.
void follow_valves(std::span<const Valve> valves, std::span<const double> op,
                   std::span<EightNumbers> mv);

}  // namespace loopscope::core::model
