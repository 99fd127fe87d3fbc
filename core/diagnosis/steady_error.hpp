#pragma once

#include <cstddef>

#include "core/hos/settings.hpp"
#include "core/signal/loop_window.hpp"
#include "core/signal/prepared_loop.hpp"

namespace loopscope::core {

/// Fewer segments than 512 samples give (15) average too little to judge.
inline constexpr std::size_t kMinSegments = 15;

/// What the higher-order statistics are taken from.
struct SteadyError {
  signal::Samples error;
  const char* flag = nullptr;  ///< sp_steps_masked or sp_moving; nullptr = sp makes no steps
};

/// The error without the transients of setpoint steps, where that leaves kMinSegments; else the
/// whole error, and the flag of a setpoint that moves too often.
[[nodiscard]] SteadyError steady_error(const signal::PreparedLoop& loop,
                                       const hos::Settings& settings);

}  // namespace loopscope::core
