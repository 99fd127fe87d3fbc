#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "daemon/catalogue/naming_rules.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// Two tags for one role of a loop.
struct AmbiguousRole {
  std::string loop;
  std::string role;
  std::vector<std::string> tags;
  std::string taken;  ///< by the order of the words; empty = none, the words are the same
};

/// Tags of a source, grouped into loops.
struct Discovery {
  std::vector<storage::CatalogueEntry> loops;  ///< with a pv, by name; only name and tags are set
  std::vector<storage::CatalogueEntry> without_pv;  ///< cannot be: nothing is known of the process
  std::vector<AmbiguousRole> ambiguous;
  std::vector<std::string> unmatched;  ///< tags that fit no pattern
  /// Loops whose tag has a word that stands for two roles (MV: manipulated variable here, valve
  /// position there), and was taken for the first role that nothing else fills.
  std::vector<std::string> by_shared_word;
};

/// Groups `tags` into loops: each tag by the first pattern that fits, loops by name whatever its
/// case. Linear in the number of tags but for sorting.
[[nodiscard]] Discovery discover_loops(std::span<const std::string> tags, const NamingRules& rules);

}  // namespace loopscope::daemon
