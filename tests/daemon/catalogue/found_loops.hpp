#pragma once

#include <string>
#include <vector>

#include "daemon/catalogue/discover_loops.hpp"

namespace loopscope::daemon {

/// "name: sp=..., pv=..." of each loop.
std::vector<std::string> found_loops(const Discovery& discovery);

}  // namespace loopscope::daemon
