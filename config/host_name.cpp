#include "config/host_name.hpp"

#include <algorithm>
#include <cstddef>

namespace loopscope::config {
namespace {

// Of the name service (RFC 1035).
constexpr std::size_t kLongestHostName = 253;
constexpr std::size_t kLongestLabel = 63;

bool may_stand_in_label(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
         (letter >= '0' && letter <= '9') || letter == '-' || letter == '_';
}

bool is_label(std::string_view text) {
  return !text.empty() && text.size() <= kLongestLabel &&
         std::all_of(text.begin(), text.end(), may_stand_in_label);
}

}  // namespace

bool is_host_name(std::string_view text) {
  if (text.size() > kLongestHostName) return false;
  for (std::size_t dot = text.find('.'); dot != std::string_view::npos; dot = text.find('.')) {
    if (!is_label(text.substr(0, dot))) return false;
    text.remove_prefix(dot + 1);
  }
  return is_label(text);
}

}  // namespace loopscope::config
