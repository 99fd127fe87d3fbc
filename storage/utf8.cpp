#include "storage/utf8.hpp"

#include <algorithm>
#include <utf8.h>

namespace loopscope::storage {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
constexpr std::size_t kLongestCharacter = 4;

}  // namespace

Character first_character(std::string_view text) {
  // Of a character's beginnings the whole alone is valid.
  for (std::size_t length = 1; length <= std::min(kLongestCharacter, text.size()); ++length) {
    const std::string_view beginning = text.substr(0, length);
    if (is_storable(beginning)) return {length, utf8::unchecked::peek_next(beginning.begin())};
  }
  return {};
}

std::size_t count_characters(std::string_view text) {
  return static_cast<std::size_t>(utf8::unchecked::distance(text.begin(), text.end()));
}

bool is_storable(std::string_view text) {
  return text.find('\0') == std::string_view::npos && utf8::is_valid(text);
}

std::string make_storable(std::string_view text) {
  if (is_storable(text)) return std::string(text);
  // Byte by byte: utf8::replace_invalid() has one mark for several, or for all up to the end.
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = first_character(text).length;
    result += length == 0 ? kReplacement : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

}  // namespace loopscope::storage
