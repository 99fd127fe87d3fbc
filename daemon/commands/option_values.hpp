#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/signal/loop_window.hpp"

namespace loopscope::daemon {

/// "LOW,HIGH" as a range; nullopt for an empty text. Throws Failure (usage) for anything else.
[[nodiscard]] std::optional<core::signal::OpRange> parse_op_range(const std::string& text);

/// Whether a loop of this type (as the catalogue spells it) integrates: level loops do.
[[nodiscard]] bool is_integrating_type(std::string_view loop_type);

}  // namespace loopscope::daemon
