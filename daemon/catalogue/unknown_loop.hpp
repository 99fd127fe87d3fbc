#pragma once

#include <string>

#include "daemon/text/failure.hpp"
#include "storage/results/catalogue/catalogue.hpp"

namespace loopscope::daemon {

/// Failure (usage): the catalogue has no such loop, and which name was probably meant. Both throw
/// storage::DatabaseError.
[[nodiscard]] Failure unknown_loop(const std::string& name, storage::Catalogue& catalogue);

/// Throws it unless the catalogue has the loop.
void require_loop(const std::string& name, storage::Catalogue& catalogue);

}  // namespace loopscope::daemon
