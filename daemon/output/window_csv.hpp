#pragma once

#include <string>

#include "core/signal/loop_window.hpp"

namespace loopscope::daemon {

/// A window as a recording that `analyze` reads: time (UTC) and the columns that were recorded,
/// every number with the digits that bring it back to the last bit; missing samples are empty.
[[nodiscard]] std::string window_csv(const core::signal::LoopWindow& window);

}  // namespace loopscope::daemon
