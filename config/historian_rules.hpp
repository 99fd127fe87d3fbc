#pragma once

#include <string>

#include "config/problem_list.hpp"
#include "config/settings.hpp"

namespace loopscope::config {

/// The rules between the settings of one historian. `path` is its own, e.g. /historians/0.
void check_historian(const HistorianSettings& historian, const std::string& path,
                     ProblemList& problems);

}  // namespace loopscope::config
