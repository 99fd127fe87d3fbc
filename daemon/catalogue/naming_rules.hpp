#pragma once

#include <string>
#include <vector>

#include "config/settings.hpp"
#include "daemon/catalogue/naming_convention.hpp"
#include "daemon/catalogue/tag_parts.hpp"
#include "daemon/catalogue/tag_pattern.hpp"

namespace loopscope::daemon {

/// How the tags of a source are grouped into loops: by the patterns of the site, the first that
/// fits counts, or, where there are none, as split_tag() reads them. Which tag has which role the
/// conventions say.
struct NamingRules {
  std::vector<TagPattern> patterns;
  /// The words of the settings first, then those of vendors and languages; not empty.
  std::vector<NamingConvention> conventions;

  /// Every word of every role as it is written, lower case, longest first, each once: "sp_track"
  /// before "sp".
  [[nodiscard]] std::vector<std::string> all_words() const;
  /// The same as plain_word() gives them.
  [[nodiscard]] PlainWords plain_words() const;
};

/// The rules of the settings file; `patterns` and `roles` ("pv=PV,MEAS") replace what it says where
/// they are given. Words of a role that are not the default ones are the only ones for that role,
/// in every convention. Throws Failure (configuration for the file, usage for the others).
[[nodiscard]] NamingRules naming_rules(const config::DiscoverySettings& settings,
                                       const std::vector<std::string>& patterns,
                                       const std::vector<std::string>& roles);

}  // namespace loopscope::daemon
