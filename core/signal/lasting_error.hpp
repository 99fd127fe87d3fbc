#pragma once

#include <span>

namespace loopscope::core::signal {

/// Whether nine in ten of the recorded samples lie beyond `least` on one and the same side of 0.
/// False where none is recorded.
[[nodiscard]] bool keeps_its_sign(std::span<const double> error, double least = 0.0);

}  // namespace loopscope::core::signal
