#pragma once

#include <cstddef>

#include "tests/core/loop/signals.hpp"

/// Records at the edge of what Harris' test calls well tuned.
namespace loopscope::core::loop::signals {

inline constexpr std::size_t kMinDelay = 2, kMaxDelay = 10, kOrder = 20;

/// p of Harris' test of that error.
[[nodiscard]] double p_of(const Series& error);

/// Noise of variance 1 with a slow AR(1) part that carries `share` of it.
[[nodiscard]] Series mixture(Random& random, std::size_t samples, double phi, double share);

/// The share at which the middle index is that of the null, by bisection on one long record.
[[nodiscard]] double share_at_null(double phi);

}  // namespace loopscope::core::loop::signals
