#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace loopscope::daemon {

/// A line of a terminal page: label in a column of its own, then the text.
[[nodiscard]] std::string text_line(std::string_view label, const std::string& text);

/// Four significant digits; "-" = unknown.
[[nodiscard]] std::string figure_text(const std::optional<double>& value);

/// A p-value as sentences say it, core::text::p_text(); "-" = unknown.
[[nodiscard]] std::string p_figure_text(const std::optional<double>& p);

}  // namespace loopscope::daemon
