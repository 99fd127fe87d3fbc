#pragma once

#include <span>
#include <string>
#include <vector>

#include "daemon/catalogue/assign_roles.hpp"
#include "daemon/catalogue/naming_rules.hpp"

namespace loopscope::daemon {

/// Tags that have a name in common, for one loop perhaps.
struct TagGroup {
  std::string path;   ///< lower case, what the group is found by: "area1/fic101"
  std::string block;  ///< the controller's block that was left out of the name, or empty: "pid1"
  std::vector<TagCandidate> candidates;  ///< not empty
};

struct GroupedTags {
  std::vector<TagGroup> groups;        ///< by path
  std::vector<std::string> unmatched;  ///< tags without a word for a role, in their order
};

/// Groups tags by name, whatever its case. By patterns of the site where there are some; else as
/// split_tag() reads them, and a controller's block within a module (FIC101/PID1, FIC101.PIDA)
/// belongs to the module, unless that has several of them.
[[nodiscard]] GroupedTags group_tags(std::span<const std::string> tags, const NamingRules& rules);

}  // namespace loopscope::daemon
