#include "tests/daemon/catalogue/found_loops.hpp"

#include "daemon/catalogue/entry_fields.hpp"

namespace loopscope::daemon {

std::vector<std::string> found_loops(const Discovery& discovery) {
  std::vector<std::string> found;
  for (const auto& entry : discovery.loops) {
    std::string text = entry.name + ":";
    for (const TagRole& role : kTagRoles) {
      if (!(entry.*role.tag).empty()) text += " " + std::string(role.name) + "=" + entry.*role.tag;
    }
    found.push_back(text);
  }
  return found;
}

}  // namespace loopscope::daemon
