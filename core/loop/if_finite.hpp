#pragma once

#include <cmath>
#include <optional>

namespace loopscope::core::loop {

/// A figure that overflowed is no figure.
[[nodiscard]] inline std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace loopscope::core::loop
