#include "daemon/catalogue/loop_type_of.hpp"

#include <array>
#include <cctype>
#include <cstddef>
#include <utility>

namespace loopscope::daemon {
namespace {

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

constexpr std::array kMeasured{
    std::pair{'F', "flow"},     std::pair{'L', "level"},    std::pair{'T', "temperature"},
    std::pair{'P', "pressure"}, std::pair{'A', "analysis"},
};

/// First letter what is measured, perhaps D (difference) or F (ratio), perhaps I or R (shown,
/// recorded), then C: a controller.
std::string type_of_letters(std::string_view letters) {
  constexpr std::size_t kShortest = 2, kLongest = 4;
  if (letters.size() < kShortest || letters.size() > kLongest || letters.back() != 'C') return {};
  for (const char c : letters.substr(1, letters.size() - 2)) {
    if (c != 'D' && c != 'F' && c != 'I' && c != 'R') return {};
  }
  for (const auto& [letter, type] : kMeasured) {
    if (letters.front() == letter) return type;
  }
  return {};
}

}  // namespace

std::string loop_type_of(std::string_view name) {
  std::string found;
  for (std::size_t k = 0; k < name.size();) {
    std::string letters;
    for (; k < name.size() && is_letter(name[k]); ++k)
      letters += static_cast<char>(std::toupper(static_cast<unsigned char>(name[k])));
    if (std::string type = type_of_letters(letters); !type.empty()) found = std::move(type);
    if (letters.empty()) ++k;
  }
  return found;
}

}  // namespace loopscope::daemon
