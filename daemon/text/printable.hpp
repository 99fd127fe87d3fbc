#pragma once

#include <string>
#include <string_view>

namespace loopscope::daemon {

/// `text` as a line of a log or a terminal may show it: names of loops and tags are what somebody
/// typed into a control system, and must not start a line of their own, steer the terminal or turn
/// the direction of writing around. Bytes that are no printable UTF-8 become \xNN; everything else
/// stays.
[[nodiscard]] std::string printable(std::string_view text);

/// Bytes of the printable character that `text` (not empty) starts with; 0 = its first byte is to
/// be escaped.
[[nodiscard]] std::size_t printable_length(std::string_view text);

/// One byte as \xNN.
[[nodiscard]] std::string escaped_byte(char byte);

}  // namespace loopscope::daemon
