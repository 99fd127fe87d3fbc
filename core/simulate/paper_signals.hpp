#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace loopscope::core::simulate {

/// The four signals of section 4, `samples` long. A linear signal and its nonlinear partner of one
/// seed hold the same noise, so that they differ by the square alone.

/// y_linear of 4.1 (eq. 15): x = 3 H d1, y = x + d2; H a Butterworth band pass from 0.095 to 0.105
/// cycles per sample, d1 of variance 1, d2 of variance 0.001. The paper does not give H's order.
[[nodiscard]] std::vector<double> narrow_band_linear(std::size_t samples, std::uint64_t seed);

/// y_nonlinear of 4.1 (eq. 16): x + 0.1 x^2 + d2.
[[nodiscard]] std::vector<double> narrow_band_squared(std::size_t samples, std::uint64_t seed);

/// x of 4.2 (eq. 17): sin(2 pi 0.12 k + pi/3) + sin(2 pi 0.30 k + pi/8) + d, d of variance 0.04.
[[nodiscard]] std::vector<double> two_sinusoids_linear(std::size_t samples, std::uint64_t seed);

/// y of 4.2 (eq. 18): x' + 0.05 x'^2 + d, x' being the two sinusoids without noise.
[[nodiscard]] std::vector<double> two_sinusoids_squared(std::size_t samples, std::uint64_t seed);

}  // namespace loopscope::core::simulate
