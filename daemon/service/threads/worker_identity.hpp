#pragma once

#include <cstddef>
#include <string>

#include "config/settings.hpp"

namespace loopscope::daemon {

/// Cores to analyse on: the setting `daemon.workers`, or all that there are. At least 1.
[[nodiscard]] std::size_t core_count(const config::DaemonSettings& settings);

/// Workers that share them: the setting `daemon.batches_in_flight`, or two for each core, so that
/// one fetches and writes while the other analyses. At least one and at most eight for each core.
[[nodiscard]] std::size_t worker_count(const config::DaemonSettings& settings);

/// Those of them that go on while all loops are compared, which takes a core: without the batches
/// of one core, whose memory is then where most is held at all. At least 1.
[[nodiscard]] std::size_t workers_beside_comparison(const config::DaemonSettings& settings);

/// As gethostname() has it; may be empty.
[[nodiscard]] std::string host_name();
/// What this process signs with: host/pid.
[[nodiscard]] std::string process_name();
/// The name that worker `index` of this process signs its claims with: host/pid/index.
[[nodiscard]] std::string worker_name(std::size_t index);

}  // namespace loopscope::daemon
