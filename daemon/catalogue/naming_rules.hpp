#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.hpp"
#include "daemon/catalogue/tag_pattern.hpp"

namespace loopscope::daemon {

/// How the tags of a source are grouped into loops: patterns, the first that fits counts, and the
/// words for each role, in lower case, the preferred one first.
struct NamingRules {
  std::vector<TagPattern> patterns;
  std::map<std::string, std::vector<std::string>, std::less<>> words;  ///< by role

  /// Every word of every role, longest first, each once: "sp_track" before "sp".
  [[nodiscard]] std::vector<std::string> all_words() const;
};

/// The rules of the settings file; `patterns` and `roles` ("pv=PV,MEAS") replace what it says where
/// they are given. Throws Failure (configuration for the file, usage for the others).
[[nodiscard]] NamingRules naming_rules(const config::DiscoverySettings& settings,
                                       const std::vector<std::string>& patterns,
                                       const std::vector<std::string>& roles);

}  // namespace loopscope::daemon
