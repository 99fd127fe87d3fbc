#pragma once

#include <span>
#include <string>
#include <vector>

#include "daemon/catalogue/assign_roles.hpp"
#include "daemon/catalogue/naming_rules.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// Tags that look like a loop and are perhaps none.
struct DoubtfulLoop {
  storage::CatalogueEntry entry;  ///< name and tags
  std::string reason;             ///< "named as a valve"
};

/// Tags of a source, grouped into loops. Every tag stands in one of the lists, or is one that its
/// loop has no use for.
struct Discovery {
  /// By name, with a pv and sp or op; only name and tags are set.
  std::vector<storage::CatalogueEntry> loops;
  std::vector<storage::CatalogueEntry> without_pv;  ///< cannot be: nothing is known of the process
  std::vector<storage::CatalogueEntry> indicators;  ///< pv alone: nothing controls it
  std::vector<DoubtfulLoop> doubtful;
  std::vector<AmbiguousRole> ambiguous;
  std::vector<std::string> unmatched;       ///< tags that fit no pattern, or name no loop's signal
  std::vector<std::string> by_shared_word;  ///< loops of RoleAssignment::by_shared_word
};

/// Groups `tags` into loops by their names, whatever their case (group_tags, assign_roles). A
/// controller without a pv takes that of the one other block of its module that has one, or of its
/// transmitter (match_transmitters). Linear in the number of tags but for sorting.
[[nodiscard]] Discovery discover_loops(std::span<const std::string> tags, const NamingRules& rules);

}  // namespace loopscope::daemon
