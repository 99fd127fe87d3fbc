#pragma once

namespace loopscope::daemon {

/// Bounds what the allocator keeps for single threads. Call once, before the first thread.
///
/// The allocator is tcmalloc (Ghemawat and Menage), but for builds with sanitizers. An analysis
/// takes and frees blocks of 8 to 200 kB a hundred times a window: glibc's malloc hands these out
/// under a lock that four workers on two cores wait for, and looks for them in lists (a tenth of
/// the program's time; daemon/MEASURED.md); jemalloc and mimalloc fetch the pages anew.
void bound_thread_caches();

/// Hands freed memory back to the kernel, some milliseconds: around a task that takes much more
/// than what is kept, now and then. Thread-safe.
void give_back_freed_memory();

}  // namespace loopscope::daemon
