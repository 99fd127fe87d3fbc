#include "daemon/output/text_line.hpp"

#include <fmt/format.h>

#include "core/text/phrases.hpp"

namespace loopscope::daemon {

std::string text_line(std::string_view label, const std::string& text) {
  return fmt::format("  {:<14}{}\n", label, text);
}

std::string figure_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : std::string("-");
}

std::string p_figure_text(const std::optional<double>& p) {
  return p ? core::text::p_text(*p) : std::string("-");
}

}  // namespace loopscope::daemon
