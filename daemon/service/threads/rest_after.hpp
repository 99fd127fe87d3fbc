#pragma once

#include <algorithm>
#include <chrono>

namespace loopscope::daemon {

using RestClock = std::chrono::steady_clock;

/// How long a thread rests after a look at the database that took so long: `least`, or twenty times
/// as long as it took, so that looks at a hundred thousand loops take a twentieth of a core at
/// most; of those ten minutes, since one that waited for a lock is no reason for more.
[[nodiscard]] constexpr RestClock::duration rest_after(RestClock::duration took,
                                                       RestClock::duration least) {
  constexpr int kTimesTaken = 20;
  constexpr RestClock::duration kLongest = std::chrono::minutes(10);
  return std::max(least, std::min(kLongest, kTimesTaken * took));
}

}  // namespace loopscope::daemon
