#pragma once

namespace loopscope::daemon {

/// Keeps freed memory in the process instead of handing it back to the kernel.
///
/// An analysis takes and frees some 200 kB a dozen times a window; fetching these pages from the
/// kernel each time costs as much as the squared bicoherence itself. What is kept is bounded by
/// what was in use at once. Call once, before the first thread.
void keep_freed_memory();

/// Hands all of it back once, some milliseconds: around a task that takes much more than what is
/// kept, now and then. Thread-safe.
void give_back_freed_memory();

}  // namespace loopscope::daemon
