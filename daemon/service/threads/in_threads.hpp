#pragma once

#include <cstddef>
#include <functional>

namespace loopscope::daemon {

/// Does one piece of work, named by its index.
using IndexedTask = std::function<void(std::size_t index)>;

/// Calls a task for every index below `count`, each once and in any order, from `threads` (>= 1)
/// threads. `make_task` runs once in every thread, so that a task may own buffers; what tasks share
/// they guard themselves. Returns when all are done. The first exception of a task ends the work
/// and is thrown here.
void in_threads(std::size_t count, std::size_t threads,
                const std::function<IndexedTask()>& make_task);

}  // namespace loopscope::daemon
