#pragma once

#include <optional>
#include <string_view>

#include "core/signal/loop_window.hpp"

namespace loopscope::daemon {

/// The text without blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Case-insensitive comparison of ASCII words.
[[nodiscard]] bool same_word(std::string_view a, std::string_view b);

/// A number cell: empty, NaN and infinity give NaN; nullopt when the text is no number.
[[nodiscard]] std::optional<double> parse_number(std::string_view cell);

/// A mode cell: a word of mode_words.hpp, or 0 manual, 1 automatic, 2 cascade;
/// anything else is unknown.
[[nodiscard]] core::signal::ControlMode parse_mode(std::string_view cell);

/// A quality cell: GOOD, or a number after OPC DA ((q & 0xC0) = 0xC0); an empty cell is good.
[[nodiscard]] bool is_good_quality(std::string_view cell);

}  // namespace loopscope::daemon
