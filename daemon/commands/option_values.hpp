#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/signal/loop_window.hpp"

namespace loopscope::daemon {

/// "LOW,HIGH" as a range; nullopt for an empty text. Throws Failure (usage) for anything else.
[[nodiscard]] std::optional<core::signal::OpRange> parse_op_range(const std::string& text);

/// The same of a transmitter's range in pv units.
[[nodiscard]] std::optional<core::signal::OpRange> parse_pv_range(const std::string& text);

}  // namespace loopscope::daemon
