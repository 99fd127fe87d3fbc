#pragma once

#include <cstddef>
#include <string>

#include "config/settings.hpp"

namespace loopscope::daemon {

/// Threads to work with: the setting, or one per core.
[[nodiscard]] std::size_t worker_count(const config::DaemonSettings& settings);

/// Workers that share them: the setting, or two for each, so that one fetches and writes while the
/// other analyses. Never fewer than the workers, nor
/// more than eight for each.
[[nodiscard]] std::size_t lane_count(const config::DaemonSettings& settings);

[[nodiscard]] std::string host_name();
/// What this process signs with: host/pid.
[[nodiscard]] std::string process_name();
/// The name that worker `index` of this process signs its claims with: host/pid/index.
[[nodiscard]] std::string worker_name(std::size_t index);

}  // namespace loopscope::daemon
