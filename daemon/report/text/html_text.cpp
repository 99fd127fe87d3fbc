#include "daemon/report/text/html_text.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <utility>

#include "daemon/text/printable.hpp"

namespace loopscope::daemon {
namespace {

using Reference = std::pair<char, const char*>;
constexpr std::array kReferences{Reference{'&', "&amp;"}, Reference{'<', "&lt;"},
                                 Reference{'>', "&gt;"}, Reference{'"', "&quot;"},
                                 Reference{'\'', "&#39;"}};

void append(std::string& shown, char character) {
  for (const auto& [special, reference] : kReferences) {
    if (special != character) continue;
    shown += reference;
    return;
  }
  shown += character;
}

/// What most texts are made of, which then need no look at each character's code.
bool shows_itself(char character) {
  return character >= ' ' && character <= '~' &&
         std::ranges::find(kReferences, character, &Reference::first) == kReferences.end();
}

bool stands_for_itself(char character) {
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
         (character >= '0' && character <= '9') ||
         std::string_view("-._~").find(character) != std::string_view::npos;
}

}  // namespace

std::string html(std::string_view text) {
  if (std::ranges::all_of(text, shows_itself)) return std::string(text);
  std::string shown;
  for (const char character : printable(text)) append(shown, character);
  return shown;
}

std::string url_value(std::string_view text) {
  std::string value;
  for (const char character : text) {
    if (stands_for_itself(character)) {
      value += character;
    } else {
      fmt::format_to(std::back_inserter(value), "%{:02X}", static_cast<unsigned char>(character));
    }
  }
  return value;
}

}  // namespace loopscope::daemon
