#pragma once

#include <string_view>
#include <vector>

namespace loopscope::daemon {

/// The parts between separators, without blanks at their ends; empty ones are left out.
[[nodiscard]] std::vector<std::string_view> split_list(std::string_view text, char separator);

}  // namespace loopscope::daemon
