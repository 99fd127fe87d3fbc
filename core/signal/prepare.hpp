#pragma once

#include "core/signal/loop_window.hpp"
#include "core/signal/prepared_loop.hpp"

namespace loopscope::core::signal {

/// Cuts the window to its last samples, bridges short gaps, forms the error and judges whether
/// the data can carry an analysis. Throws std::invalid_argument for series of different lengths
/// and for a sample interval that is not above 0 or not finite.
[[nodiscard]] PreparedLoop prepare(const LoopWindow& window, const PrepareSettings& settings);

}  // namespace loopscope::core::signal
