#pragma once

#include <optional>
#include <span>

namespace loopscope::core::loop {

/// How long the error of a loop remembers, in samples: the first lag at which its autocorrelation
/// has fallen to 1/e of what it is at three samples, past white noise.
///
/// A loop with integral action makes up for a load within its closed-loop time constant T, whatever
/// the load: below the frequency 1/T its sensitivity falls in proportion to the frequency, so that
/// the error of a load that drifts without end is flat there. So the memory of the error is at most
/// about T, and shorter where the load itself is. Gaps (NaN) count for nothing.
///
/// nullopt: too few samples, a constant error, or one that is mostly white noise (autocorrelation
/// below 0.1 at three samples). A memory longer than a quarter of the record comes out as that.
[[nodiscard]] std::optional<double> error_memory_samples(std::span<const double> error);

}  // namespace loopscope::core::loop
