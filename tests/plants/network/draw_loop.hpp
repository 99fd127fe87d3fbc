#pragma once

#include "tests/effects/random.hpp"
#include "tests/plants/network/plan.hpp"

namespace loopscope::tests::network {

/// A loop of this kind: process, PI by SIMC (Skogestad 2003), noise, sampling, and a valve with the
/// little play that healthy ones have.
[[nodiscard]] LoopPlan draw_loop(LoopKind kind, effects::Random& random);

/// A valve that sticks enough to make a cycle: He's or Karnopp's friction, or, for a vessel, wide
/// play at times.
void make_stick(LoopPlan& loop, effects::Random& random);

/// A controller close to the edge of stability: a cycle of its own that the noise keeps up.
void make_tight(LoopPlan& loop, effects::Random& random);

}  // namespace loopscope::tests::network
