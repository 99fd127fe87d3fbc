#pragma once

#include <span>
#include <string>

#include "daemon/text/failure.hpp"
#include "storage/results/catalogue/catalogue.hpp"

namespace loopscope::daemon {

/// Failure (usage): the catalogue, all of it, has no such loop, and which name was probably meant.
[[nodiscard]] Failure unknown_loop(const std::string& name,
                                   std::span<const storage::CatalogueEntry> all);

/// The same of a catalogue that is read for it. Throws storage::DatabaseError, as the next one.
[[nodiscard]] Failure unknown_loop(const std::string& name, storage::Catalogue& catalogue);

/// Throws it unless the catalogue has the loop.
void require_loop(const std::string& name, storage::Catalogue& catalogue);

}  // namespace loopscope::daemon
