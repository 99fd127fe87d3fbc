#pragma once

#include <string>

#include "daemon/setup/site_logins.hpp"

namespace loopscope::daemon {

/// Whether a login works, for a terminal, with what to do about it where the SQL for it does not
/// say everything. Every line ends with a line break.
[[nodiscard]] std::string login_text(const SiteLogin& login);

}  // namespace loopscope::daemon
