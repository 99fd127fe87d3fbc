#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace loopscope::daemon {

/// Stands where a figure is not known: a dash.
inline constexpr const char* kUnknown = "\u2013";

/// A code of the results as people write it: "valve_stiction" is "valve stiction".
[[nodiscard]] std::string in_words(std::string_view code);
/// The same as a heading: "Valve stiction".
[[nodiscard]] std::string as_heading(std::string_view code);

/// Two decimals, for shares and weights.
[[nodiscard]] std::string two_decimals(double value);

/// Three significant digits; kUnknown for what is.
[[nodiscard]] std::string digits(const std::optional<double>& value);

/// A p-value as sentences say it, core::text::p_text(), plain text: "0.03", "< 1e-12";
/// kUnknown for what is.
[[nodiscard]] std::string p_text(const std::optional<double>& p);

/// The number; empty = there is none.
[[nodiscard]] std::string number_text(const std::optional<std::int64_t>& number);

/// The status of a loop on the list in words: "watch" is "not yet confirmed".
[[nodiscard]] std::string status_words(const std::string& status);

/// What somebody did to take a finding off the list: "Suppressed", "Marked as a false positive";
/// behind it stands the name.
[[nodiscard]] std::string deed_words(const std::string& hidden_by);

}  // namespace loopscope::daemon
