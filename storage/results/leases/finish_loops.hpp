#pragma once

#include <span>

#include "storage/loop_work.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {

/// Writes results and gives the loops back, as ResultsDatabase::finish() says.
WriteCount finish_loops(Transaction& transaction, std::span<const CompletedLoop> completed,
                        std::span<const FailedLoop> failed);

}  // namespace loopscope::storage
