#pragma once

#include <string>

namespace loopscope::config {

/// Every setting with its default, range, unit and meaning as a Markdown table (for SETTINGS.md and
/// `check-config --describe`).
[[nodiscard]] std::string describe_settings();

}  // namespace loopscope::config
