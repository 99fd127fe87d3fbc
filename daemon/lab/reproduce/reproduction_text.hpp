#pragma once

#include <string>

#include "daemon/lab/reproduce/reproduction.hpp"

namespace loopscope::daemon {

/// For people: one block per example, the paper's figure beside ours, then section 6.
[[nodiscard]] std::string reproduction_text(const Reproduction& reproduction);

}  // namespace loopscope::daemon
