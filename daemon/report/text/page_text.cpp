#include "daemon/report/text/page_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/text/phrases.hpp"

namespace loopscope::daemon {

std::string two_decimals(double value) {
  return fmt::format("{:.2f}", value);
}

std::string digits(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? core::text::number(*value) : kUnknown;
}

std::string p_text(const std::optional<double>& p) {
  return p && std::isfinite(*p) ? core::text::p_text(*p) : kUnknown;
}

std::string number_text(const std::optional<std::int64_t>& number) {
  return number ? std::to_string(*number) : "";
}

std::string in_words(std::string_view code) {
  return core::text::code_words(code);
}

std::string as_heading(std::string_view code) {
  std::string words = in_words(code);
  if (!words.empty() && words.front() >= 'a' && words.front() <= 'z')
    words.front() = static_cast<char>(words.front() - 'a' + 'A');
  return words;
}

std::string status_words(const std::string& status) {
  return status == "watch" ? "not yet confirmed" : status;
}

std::string deed_words(const std::string& hidden_by) {
  return hidden_by == "false_positive" ? "Marked as a false positive" : as_heading(hidden_by);
}

}  // namespace loopscope::daemon
