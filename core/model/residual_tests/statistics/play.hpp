#pragma once

#include <span>
#include <vector>

namespace loopscope::core::model {

/// How far a valve with this much play stands behind op, % of op:
///
///     mv = max(op - w/2, min(op + w/2, mv before)),   lag = mv - op within -w/2 to w/2
///
/// It is -w/2 while op goes up, w/2 while it goes down, and on the way from one to the other for w
/// after each reversal: direction and travel since the reversal in one figure, that no noise on op
/// narrower than w disturbs. NaN where op is; the valve stands meanwhile.
[[nodiscard]] std::vector<double> lag_of_play(std::span<const double> op_percent,
                                              double width_percent);

}  // namespace loopscope::core::model
