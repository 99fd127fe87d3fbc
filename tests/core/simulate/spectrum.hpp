#pragma once

#include <vector>

namespace loopscope::core::simulate::tests {

/// Mean power of a signal at a frequency (cycles per sample): |sum x exp(-2 pi i f k)|^2 / N,
/// averaged over segments of 1024 samples.
[[nodiscard]] double power_at(const std::vector<double>& signal, double frequency);

/// About the mean.
[[nodiscard]] double variance(const std::vector<double>& signal);

}  // namespace loopscope::core::simulate::tests
