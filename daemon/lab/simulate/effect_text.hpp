#pragma once

#include <string>

#include "core/simulate/effect.hpp"

namespace loopscope::daemon {

/// "valve_stiction:S=3,J=1" as an effect; the part from the colon on may be missing. Throws
/// Failure (usage), with the nearest known name as a hint, for anything else.
[[nodiscard]] core::simulate::Effect parse_effect(const std::string& text);

/// Throws Failure (usage), with the nearest known name as a hint, unless a scenario is called so.
void require_scenario(const std::string& name);

}  // namespace loopscope::daemon
