#pragma once

#include <string>

#include "daemon/report/sections/loop_section.hpp"

namespace loopscope::daemon {

/// What the loop's data are worth: what is wrong with them and what mends it, and the figures of
/// the window.
[[nodiscard]] std::string data_section(const LoopReport& story);

}  // namespace loopscope::daemon
