#pragma once

#include "config/problem_list.hpp"
#include "config/settings.hpp"

namespace loopscope::config {

/// Every rule that ties one setting to another. A rule over a value that was refused is silent.
void check_cross_rules(const Settings& settings, ProblemList& problems);

}  // namespace loopscope::config
