#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "core/signal/loop_window.hpp"

namespace loopscope::daemon {

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

}  // namespace loopscope::daemon
