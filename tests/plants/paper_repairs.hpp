#pragma once

#include <cstddef>
#include <cstdint>

#include "tests/plants/repair.hpp"

namespace loopscope::tests::repairs {

/// The two repairs of the seed paper, simulated: sampled every minute, `windows` before and after.
///
/// Section 6.2.1: a recycle flow whose 6 inch valve is too large, so that it works within half a
/// percent of travel near its resolution; replaced by a 3 inch valve. Nothing is left.
[[nodiscard]] Repair flow_loop_1(std::size_t windows, std::uint64_t seed);

/// Section 6.2.2: a flow behind a pump whose seat and plug are corroded: the stem drags, and below
/// its working point hardly throttles; replaced by a valve whose characteristic is bent, but less.
[[nodiscard]] Repair flow_loop_2(std::size_t windows, std::uint64_t seed);

}  // namespace loopscope::tests::repairs
