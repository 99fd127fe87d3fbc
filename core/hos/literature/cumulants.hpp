#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

namespace loopscope::core::hos {

/// Third-order cumulant c3(t1, t2) = E[x(k) x(k + t1) x(k + t2)] of the signal about its mean, in
/// its unit cubed: element (max_lag + t1, max_lag + t2) of a square of 2 max_lag + 1.
///
/// It is known on the hexagon |t1|, |t2|, |t1 - t2| <= max_lag and zero outside. Only the sixth
/// 0 <= t2 <= t1 is averaged from the data, over the triples without a missing sample (NaN or
/// infinity); the symmetries of a stationary signal give the rest,
///
///     c3(t1, t2) = c3(t2, t1) = c3(-t2, t1 - t2) = c3(t2 - t1, -t1) = ...
///
/// c3(0, 0) is the third central moment. Lags that no triple spans have zero. Empty when no sample
/// is finite.
[[nodiscard]] Eigen::MatrixXd third_order_cumulant(std::span<const double> signal,
                                                   std::size_t max_lag);

}  // namespace loopscope::core::hos
