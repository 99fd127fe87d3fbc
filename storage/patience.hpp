#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "storage/connection_settings.hpp"

namespace loopscope::storage {

/// How long the client waits for a statement before it gives the connection up; nullopt = for ever.
///
/// The server's own statement_timeout comes first when all is well. A server that stands still
/// without dying (stopped, out of memory, its disk stuck) keeps its connections alive, so that
/// neither that nor any keepalive would ever end the wait.
[[nodiscard]] inline std::optional<std::chrono::seconds> patience(
    const ConnectionSettings& settings) {
  constexpr int kLongestGrace_s = 5;
  if (settings.statement_timeout_s <= 0) return std::nullopt;
  const int grace_s = std::clamp(settings.statement_timeout_s / 3, 1, kLongestGrace_s);
  return std::chrono::seconds(settings.statement_timeout_s + grace_s);
}

}  // namespace loopscope::storage
