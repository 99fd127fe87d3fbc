#pragma once

#include <vector>

#include "storage/loop_work.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {

/// Notes the problems of loops whose lease was confirmed in the same transaction, and counts on
/// where one stood at the loop's slot before already.
void write_problems(Transaction& transaction, const std::vector<const CompletedLoop*>& loops);

}  // namespace loopscope::storage
