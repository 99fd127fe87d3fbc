#pragma once

#include "config/problem_list.hpp"
#include "config/settings.hpp"

namespace loopscope::config {

/// The rules of /daemon/acknowledge. What is there is checked though it is off; what it needs of
/// other settings only while it is on.
void check_acknowledge(const Settings& settings, ProblemList& problems);

}  // namespace loopscope::config
