#include "storage/utf8.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace loopscope::storage {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

struct Lead {
  std::size_t length;        // bytes of the whole character; 0 = not a lead byte
  std::uint8_t second_low;   // range of the second byte: it excludes overlong forms, surrogates
  std::uint8_t second_high;  // and what lies above U+10FFFF (Unicode 15, table 3-7)
};

Lead classify(std::uint8_t byte) {
  if (byte >= 0x01 && byte <= 0x7F) return {1, 0, 0};
  if (byte >= 0xC2 && byte <= 0xDF) return {2, 0x80, 0xBF};
  if (byte == 0xE0) return {3, 0xA0, 0xBF};
  if (byte == 0xED) return {3, 0x80, 0x9F};
  if (byte >= 0xE1 && byte <= 0xEF) return {3, 0x80, 0xBF};
  if (byte == 0xF0) return {4, 0x90, 0xBF};
  if (byte >= 0xF1 && byte <= 0xF3) return {4, 0x80, 0xBF};
  if (byte == 0xF4) return {4, 0x80, 0x8F};
  return {0, 0, 0};
}

bool in_range(char character, std::uint8_t low, std::uint8_t high) {
  const auto byte = static_cast<std::uint8_t>(character);
  return byte >= low && byte <= high;
}

}  // namespace

std::size_t character_length(std::string_view text) {
  const Lead lead = classify(static_cast<std::uint8_t>(text.front()));
  if (lead.length == 0 || text.size() < lead.length) return 0;
  if (lead.length > 1 && !in_range(text[1], lead.second_low, lead.second_high)) return 0;
  for (std::size_t i = 2; i < lead.length; ++i) {
    if (!in_range(text[i], 0x80, 0xBF)) return 0;
  }
  return lead.length;
}

bool is_storable(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string make_storable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    result += length == 0 ? kReplacement : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

}  // namespace loopscope::storage
