#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/loop/real_transform.hpp"

namespace loopscope::core::loop {

/// Correlation function of two series over the lags -max_lag .. max_lag.
struct Correlation {
  std::vector<double> values;  ///< -1 to 1 up to sampling error; 2 max_lag + 1 of them
  std::size_t max_lag = 0;

  /// Lag in samples, |lag| <= max_lag.
  [[nodiscard]] double at(std::ptrdiff_t lag) const {
    return values[static_cast<std::size_t>(lag + static_cast<std::ptrdiff_t>(max_lag))];
  }
};

/// r(l) = mean over the pairs that are there of (x(k) - mx)(y(k + l) - my) / (sx sy).
///
/// Each lag is divided by its own number of pairs, so that gaps (NaN) neither shrink r nor shift
/// its zeros. `x` and `y` have one length n; the transform has at least n + max_lag. The lags end
/// before the first one with fewer pairs than an eighth of the samples of the poorer series;
/// max_lag of the result says where. No values when a series is constant.
[[nodiscard]] Correlation correlate(std::span<const double> x, std::span<const double> y,
                                    std::size_t max_lag, RealTransform& transform);

/// correlate(x, x) for the lags 0 .. max_lag only.
[[nodiscard]] std::vector<double> autocorrelate(std::span<const double> x, std::size_t max_lag,
                                                RealTransform& transform);

}  // namespace loopscope::core::loop
