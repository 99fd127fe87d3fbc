#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/hos/transforms/settings.hpp"
#include "core/signal/loop_window.hpp"
#include "core/signal/prepared_loop.hpp"

namespace loopscope::core {

/// Fewer segments than 512 samples give (15) average too little to judge.
inline constexpr std::size_t kMinSegments = 15;

/// What the higher-order statistics are taken from: series in pv units, NaN = missing or masked.
struct SteadyError {
  signal::Samples error;
  /// The error less the loop's linear answer to its setpoint, where that moves too often to be left
  /// out (core/loop/setpoint_response.hpp): what the tests are made on. Empty = `error`.
  signal::Samples residual;
  const char* flag = nullptr;  ///< sp_steps_masked or sp_moving; nullptr = sp makes no steps
  bool stationary = true;      ///< false: see stretch, or refusal
  std::string stretch;         ///< which samples are left, in plain words; empty = not cut
  std::string refusal;         ///< why the tests may not be believed; empty = they may

  [[nodiscard]] const signal::Samples& tested() const {
    return residual.empty() ? error : residual;
  }
};

/// The error without the transients of setpoint steps, where that leaves kMinSegments; else the
/// whole error, what is left of it without the answer to the setpoint, and the flag of a setpoint
/// that moves too often. What pv's archive did not store is
/// drawn (core/hos/linear/draw_missing.hpp); the same seed draws the same. Where the loop changes
/// within the record, all but the longest stationary stretch
/// (core/hos/linear/stationary_stretch.hpp) is masked; where that leaves fewer than kMinSegments
/// nothing is, and the tests are to be refused.
[[nodiscard]] SteadyError steady_error(const signal::PreparedLoop& loop,
                                       const hos::Settings& settings, std::uint64_t seed);

}  // namespace loopscope::core
