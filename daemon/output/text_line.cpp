#include "daemon/output/text_line.hpp"

#include <fmt/format.h>

namespace loopscope::daemon {

std::string text_line(std::string_view label, const std::string& text) {
  return fmt::format("  {:<14}{}\n", label, text);
}

std::string figure_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : std::string("-");
}

}  // namespace loopscope::daemon
