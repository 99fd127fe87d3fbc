#pragma once

#include <span>

namespace loopscope::core::signal {

/// Whether an output stands and only its reading moves: no course beyond its noise, and none of its
/// moves is an answer to the error (correlation of its steps with the error and with the error's
/// steps, up to three samples before, below five standard errors). False where it moves fewer than
/// 100 times, or the error never does: an answer would not show.
/// @param op     controller output, any unit; NaN = missing
/// @param error  sp - pv, pv units, as long as `op`
[[nodiscard]] bool is_read_back_noise(std::span<const double> op, std::span<const double> error);

}  // namespace loopscope::core::signal
