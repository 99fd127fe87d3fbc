#pragma once

#include <span>

#include "config/setting_table.hpp"

namespace loopscope::config {

/// The settings of one historian, in the order of the documentation: part of setting_table().
[[nodiscard]] std::span<const Setting> historian_setting_table();

}  // namespace loopscope::config
