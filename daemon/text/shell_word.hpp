#pragma once

#include <string>

namespace loopscope::daemon {

/// A text as a shell takes it for one word: as it is, or between quotes.
[[nodiscard]] std::string shell_word(const std::string& text);

}  // namespace loopscope::daemon
