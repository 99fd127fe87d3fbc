#include "daemon/report/text/verdict_words.hpp"

#include <algorithm>

namespace loopscope::daemon {

std::string in_words(std::string_view code) {
  std::string words(code);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string as_heading(std::string_view code) {
  std::string words = in_words(code);
  if (!words.empty() && words.front() >= 'a' && words.front() <= 'z')
    words.front() = static_cast<char>(words.front() - 'a' + 'A');
  return words;
}

}  // namespace loopscope::daemon
