#pragma once

#include <string>
#include <string_view>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// 16 hexadecimal digits over every sample of the window, its times and `settings` (any text that
/// names the settings in force). Equal input gives equal digits on every machine; a late row that
/// changes one sample changes them. FNV-1a, 64 bit: meant to notice change, not to resist malice.
[[nodiscard]] std::string window_digest(const LoopWindow& window, std::string_view settings);

}  // namespace loopscope::core::signal
