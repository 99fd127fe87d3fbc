#pragma once

#include <optional>
#include <span>

namespace loopscope::core::model {

/// Whether half cycles of the error are longer or sooner over the larger the error is; no model of
/// the process is needed. A controller crosses the band of a valve that sticks sooner the larger
/// the error is; the half cycles of noise and of a load that wanders grow with their length, those
/// of a wave from outside come when they come.
///
/// Covariance of ln(length) and ln(mean error) over the mean of their variances, in the band of
/// the cycle, drawn towards 0 where there are few half cycles: -1 = the larger the sooner over,
/// 1 = the larger the longer. `error`: sp - pv without holes; `period_samples` >= 2. nullopt with
/// fewer than three cycles' samples or six half cycles.
[[nodiscard]] std::optional<double> pace_by_size(std::span<const double> error,
                                                 double period_samples);

}  // namespace loopscope::core::model
