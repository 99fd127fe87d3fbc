#pragma once

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// `pv` without the samples that only repeat the one before; as it is when there are no more of
/// them than its grid of values explains. Neither the highest nor the lowest value is taken for a
/// repetition where pv comes back to it: it is clipped there.
[[nodiscard]] Samples without_repeats(const Samples& pv);

/// `pv` without the samples that lie on the straight line between their neighbours; as it is when
/// there are no more of them than its grid of values explains.
[[nodiscard]] Samples without_collinear(const Samples& pv);

}  // namespace loopscope::core::signal
