#pragma once

/// Characters of names, whatever the locale: what is above ASCII is neither.
namespace loopscope::daemon {

[[nodiscard]] constexpr bool is_ascii_digit(char c) {
  return c >= '0' && c <= '9';
}

[[nodiscard]] constexpr bool is_ascii_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

}  // namespace loopscope::daemon
