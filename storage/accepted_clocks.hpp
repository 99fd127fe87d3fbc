#pragma once

#include <map>
#include <string>

namespace loopscope::storage {

/// By how many seconds each clock was ahead of the results server's (negative: behind) when a
/// person said that the server's is right; by clock: "host NAME", "historian NAME".
using AcceptedClocks = std::map<std::string, double>;

}  // namespace loopscope::storage
