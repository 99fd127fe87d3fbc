#pragma once

#include <cstddef>

#include "storage/results/session/session.hpp"

namespace loopscope::storage {

/// ResultsDatabase::recall_stray().
std::size_t recall_stray(Transaction& transaction, double settle_s);

}  // namespace loopscope::storage
