#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace loopscope::core::loop {

/// The Harris index at the shortest and at the longest plausible delay, 0 to 1.
struct HarrisRange {
  double low = 0.0;
  double high = 0.0;
  /// Probability that a well tuned loop shows an index this small by chance (harris_p.hpp).
  double p = 1.0;
};

/// Harris (1989), read from an AR model of the error (Desborough and Harris 1992): no controller
/// can touch what a disturbance does within the delay d, so
/// sigma_mv^2 = sigma_a^2 (psi_0^2 + ... + psi_{d-1}^2) is the least variance, and the index is
/// sigma_mv^2 / variance of the error, 0 to 1. A longer delay excuses more, so low belongs to
/// `min_delay` and high to `max_delay` (samples, 1 <= min_delay <= max_delay). `error`: any unit,
/// NaN = missing; `ar_order` >= 1. nullopt when the error does not vary or leaves fewer than 5
/// (ar_order + 1) rows for the model (ar_model.hpp).
[[nodiscard]] std::optional<HarrisRange> measure_harris(std::span<const double> error,
                                                        std::size_t min_delay,
                                                        std::size_t max_delay,
                                                        std::size_t ar_order);

}  // namespace loopscope::core::loop
