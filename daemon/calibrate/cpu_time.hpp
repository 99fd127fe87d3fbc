#pragma once

namespace loopscope::daemon {

/// CPU seconds that the calling thread has used: what a piece of work costs, whatever else runs.
[[nodiscard]] double thread_cpu_s();

}  // namespace loopscope::daemon
