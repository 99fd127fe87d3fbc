#pragma once

#include <optional>
#include <string>

namespace loopscope::daemon {

/// Who entered something: "J. Doe (login ls_engineer)", or the login alone where nobody else is
/// named. The login is what the server noted, the name what whoever used it said. Any text, not
/// made printable.
[[nodiscard]] std::string author_text(const std::string& login,
                                      const std::optional<std::string>& on_behalf_of);

}  // namespace loopscope::daemon
