#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace loopscope::storage {

/// What a database server says of the time.
struct ServerClock {
  std::int64_t now_us = 0;  ///< its clock, microseconds UTC
  /// When it was started, microseconds UTC: two connections with the same one lead to the same
  /// server, so that its clock is one witness and not two.
  std::int64_t started_us = 0;

  bool operator==(const ServerClock&) const = default;
};

/// Told the clock of the results server at the beginning of every transaction that claims or
/// writes, whose now() it is; throws DatabaseError where that clock is not to be believed.
using ClockCheck = std::function<void(const ServerClock&)>;

/// By how many seconds each clock was ahead of the results server's (negative: behind) when a
/// person said that the server's is right; by clock: "host NAME", "historian NAME".
using AcceptedClocks = std::map<std::string, double>;

}  // namespace loopscope::storage
