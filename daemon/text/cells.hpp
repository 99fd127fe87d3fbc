#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "core/signal/loop_window.hpp"

namespace loopscope::daemon {

/// The text without blanks and tabs at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Case-insensitive comparison of ASCII words.
[[nodiscard]] bool same_word(std::string_view a, std::string_view b);

/// A number cell: empty, NaN, infinity and what a double cannot hold give NaN; nullopt when the
/// text is no number.
[[nodiscard]] std::optional<double> parse_number(std::string_view cell);

/// The same with '.' or ',' as the decimal sign; the other one stands in no number.
[[nodiscard]] std::optional<double> parse_number(std::string_view cell, char decimal_sign);

/// What plants write into a mode tag, case aside; those of FOUNDATION Fieldbus among them. Whoever
/// tracks, is out of service or has its output set from elsewhere does not control. No word that a
/// tag of another kind may hold.
inline constexpr std::array kModeWords{
    std::pair{std::string_view{"MAN"}, core::signal::ControlMode::manual},
    std::pair{std::string_view{"MANUAL"}, core::signal::ControlMode::manual},
    std::pair{std::string_view{"TRACK"}, core::signal::ControlMode::manual},
    std::pair{std::string_view{"TRACKING"}, core::signal::ControlMode::manual},
    std::pair{std::string_view{"TRK"}, core::signal::ControlMode::manual},
    std::pair{std::string_view{"OOS"}, core::signal::ControlMode::manual},
    std::pair{std::string_view{"OUT OF SERVICE"}, core::signal::ControlMode::manual},
    std::pair{std::string_view{"IMAN"}, core::signal::ControlMode::manual},
    std::pair{std::string_view{"ROUT"}, core::signal::ControlMode::manual},
    std::pair{std::string_view{"AUTO"}, core::signal::ControlMode::automatic},
    std::pair{std::string_view{"AUTOMATIC"}, core::signal::ControlMode::automatic},
    std::pair{std::string_view{"CAS"}, core::signal::ControlMode::cascade},
    std::pair{std::string_view{"CASCADE"}, core::signal::ControlMode::cascade},
    std::pair{std::string_view{"RCAS"}, core::signal::ControlMode::cascade},
};

/// A mode cell: a word of kModeWords, or M or 0 manual, A or 1 automatic, C or 2 cascade, case
/// aside; anything else is unknown.
[[nodiscard]] core::signal::ControlMode parse_mode(std::string_view cell);

/// A quality cell: GOOD, or a number after OPC DA ((q & 0xC0) = 0xC0); an empty cell is good.
[[nodiscard]] bool is_good_quality(std::string_view cell);

}  // namespace loopscope::daemon
