#pragma once

#include <span>
#include <vector>

namespace loopscope::core::model {

/// Periods, in samples, at which a limit cycle may run: that with most power in the error, and that
/// at which op turns back by a good part of its travel, where they differ. The spectrum misses
/// cycles of which fewer than nine are recorded, and cycles whose harmonics or noise stand out more
/// than they do; op's large turns miss cycles on a drift. Neither series has holes; at least one.
[[nodiscard]] std::vector<double> candidate_periods(std::span<const double> error,
                                                    std::span<const double> op);

}  // namespace loopscope::core::model
