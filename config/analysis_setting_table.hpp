#pragma once

#include <span>

#include "config/setting_table.hpp"

namespace loopscope::config {

/// The settings of the analysis, in the order of the documentation: part of setting_table().
[[nodiscard]] std::span<const Setting> analysis_setting_table();

}  // namespace loopscope::config
