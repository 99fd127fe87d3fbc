#pragma once

namespace loopscope::core::loop {

/// The ratio of two variance estimates of equal expectation, `freedom_1` over `freedom_2` degrees
/// of freedom (> 0), as a standard normal deviate: Paulson's approximation (1942) to the F
/// distribution by the cube roots of Wilson and Hilferty. `ratio` >= 0.
[[nodiscard]] double variance_ratio_deviate(double ratio, double freedom_1, double freedom_2);

/// Upper tail of the standard normal distribution.
[[nodiscard]] double upper_normal_tail(double deviate);

}  // namespace loopscope::core::loop
