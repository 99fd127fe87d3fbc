#pragma once

#include <cstddef>
#include <cstdint>

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
/// whole error, and the flag of a setpoint that moves too often. What pv's archive did not store is
/// drawn (core/hos/draw_missing.hpp); the same seed draws the same.
[[nodiscard]] SteadyError steady_error(const signal::PreparedLoop& loop,
                                       const hos::Settings& settings, std::uint64_t seed);

}  // namespace loopscope::core
