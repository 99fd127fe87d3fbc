#include "core/diagnosis/analysis_settings.hpp"

#include <algorithm>
#include <cctype>

namespace loopscope::core {
namespace {

bool is_blank(char letter) {
  return std::isspace(static_cast<unsigned char>(letter)) != 0;
}

std::string_view without_blanks(std::string_view text) {
  const auto first = std::ranges::find_if_not(text, is_blank);
  const auto last = std::find_if_not(text.rbegin(), std::make_reverse_iterator(first), is_blank);
  return {first, last.base()};
}

}  // namespace

bool is_integrating_type(std::string_view loop_type) {
  return std::ranges::equal(without_blanks(loop_type), std::string_view("level"), {},
                            [](unsigned char letter) { return std::tolower(letter); });
}

}  // namespace loopscope::core
