#pragma once

#include <optional>

#include "daemon/service/threads/retry_pause.hpp"

namespace loopscope::daemon {

/// How a lane's look for work has ended.
struct Look {
  bool failed = false;  ///< the results database did
  bool worked = false;  ///< at least one batch was brought to its end
  /// Until a loop falls due or a claim ends; 0 = one is due that could not be claimed.
  double next_due_in_s = 0.0;
};

/// Seconds until the lane looks again: when the next loop falls due, but after a poll at the
/// latest, since other loops may be added; a little later at random, so that not all lanes of a
/// plant come at once. Where something is due that cannot be claimed (others have it in hand, a
/// lock is held, its source is away) and after a fault `pause` grows from look to look, up to a
/// poll and to when a source that is away may be tried again.
[[nodiscard]] double idle_pause_s(const Look& look, double poll_s,
                                  std::optional<double> source_opens_in_s, RetryPause& pause);

}  // namespace loopscope::daemon
