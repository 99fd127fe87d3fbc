#pragma once

#include <vector>

#include "core/model/candidates.hpp"
#include "core/model/contestant.hpp"

namespace loopscope::core::model {

/// The best trial of every kind that has anything to show, the least probable by chance first. What
/// is scored once has no mirror yet.
[[nodiscard]] std::vector<Contestant> hold_contest(const Round& round);

}  // namespace loopscope::core::model
