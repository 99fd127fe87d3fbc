#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace loopscope::daemon {

/// `text` as one line of valid UTF-8 of at most `most_bytes` (3 at least): control characters
/// become blanks, bytes that are no UTF-8 become U+FFFD, and what is too long ends in "...". For
/// names out of settings and databases that go to other programs.
[[nodiscard]] std::string plain_line(std::string_view text, std::size_t most_bytes);

}  // namespace loopscope::daemon
