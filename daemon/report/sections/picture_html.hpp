#pragma once

#include <string>

#include "daemon/report/figures/figure.hpp"

namespace loopscope::daemon {

/// A picture with its title above it.
[[nodiscard]] std::string picture_html(const Picture& picture);

}  // namespace loopscope::daemon
