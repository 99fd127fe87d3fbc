#include "daemon/text/printable.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fmt/format.h>

#include "storage/utf8.hpp"

namespace loopscope::daemon {
namespace {

struct CodePoints {
  char32_t first;
  char32_t last;
};

/// Characters without a picture of their own that steer the terminal or the text around them. The
/// joiners U+200C and U+200D stay: Persian and Indian writing needs them.
constexpr std::array<CodePoints, 12> kSteering{{
    {0x0000, 0x001F},    // line breaks, tabs, ESC
    {0x007F, 0x009F},    // DEL and what terminals take for ESC and a letter
    {0x061C, 0x061C},    // Arabic letter mark
    {0x180E, 0x180E},    // invisible
    {0x200B, 0x200B},    // zero width
    {0x200E, 0x200F},    // left to right, right to left
    {0x2028, 0x202E},    // line and paragraph breaks, direction of writing
    {0x2060, 0x206F},    // invisible operators, direction of writing
    {0xFEFF, 0xFEFF},    // byte order mark
    {0xFFF9, 0xFFFB},    // annotations between lines
    {0xFFFE, 0xFFFF},    // no characters
    {0xE0000, 0xE0FFF},  // tags, variations
}};

bool steers(char32_t code) {
  return std::ranges::any_of(kSteering, [code](const CodePoints& range) {
    return code >= range.first && code <= range.last;
  });
}

}  // namespace

std::size_t printable_length(std::string_view text) {
  const storage::Character first = storage::first_character(text);
  return steers(first.code) ? 0 : first.length;
}

std::string escaped_byte(char byte) {
  return fmt::format("\\x{:02x}", static_cast<std::uint8_t>(byte));
}

std::string printable(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = printable_length(text);
    if (length > 0) {
      shown += text.substr(0, length);
    } else {
      shown += escaped_byte(text.front());
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return shown;
}

}  // namespace loopscope::daemon
