#pragma once

#include <span>
#include <string_view>

#include "config/settings.hpp"

namespace loopscope::config {

/// Names of the presets: narrow, loop_row, wide, and the vendors whose tables are known.
[[nodiscard]] std::span<const std::string_view> preset_names();

/// The settings of a historian with the vendor's own tables; what a site has to say itself (the
/// connection, tables that have no usual name) is empty. Throws std::invalid_argument for a name
/// that is none of preset_names().
[[nodiscard]] HistorianSettings historian_preset(std::string_view name);

}  // namespace loopscope::config
