#pragma once

#include <span>
#include <string>
#include <vector>

#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// The loops that are meant, in the catalogue's order, each once: by name, or by pattern, where `*`
/// stands for any characters, `?` for one and `[ab]` for one of these ("FIC-*"). A name that a loop
/// has is that loop, whatever characters it holds. Throws Failure (usage) for what fits no loop.
[[nodiscard]] std::vector<storage::CatalogueEntry> select_loops(
    std::span<const storage::CatalogueEntry> all, std::span<const std::string> names);

}  // namespace loopscope::daemon
