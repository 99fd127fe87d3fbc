#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/simulate/innovations.hpp"

namespace loopscope::core::simulate {

/// All-pole filter x(k) = a1 x(k-1) + a2 x(k-2) + w(k).
struct AllPole {
  double a1 = 0.0;
  double a2 = 0.0;
};

/// One real pole, 0 to 1; 1 makes a random walk, 0 leaves the innovations white.
[[nodiscard]] AllPole real_pole(double pole);

/// A pair of poles radius exp(+-2 pi i / period): noise that swings with about that period
/// (samples, above 2), the longer in step the closer `radius` is to 1 (0 to below 1).
[[nodiscard]] AllPole resonance(double period_samples, double radius);

/// What the filter makes of innovations of variance 1, in their unit: a linear process. 4000
/// samples run ahead of the record, so that a stable filter with poles up to 0.995 has forgotten
/// where it started.
[[nodiscard]] std::vector<double> coloured_noise(const AllPole& filter, Innovation law,
                                                 std::size_t samples, std::uint64_t seed);

}  // namespace loopscope::core::simulate
