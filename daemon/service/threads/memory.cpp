#include "daemon/service/threads/memory.hpp"

#include <malloc.h>
#include <thread>

namespace loopscope::daemon {

void keep_freed_memory() {
  constexpr int kMebibyte = 1024 * 1024;
  // Blocks above the first figure come from the kernel one by one; above the second at the end of
  // the heap goes back to it.
  // NOLINTBEGIN(concurrency-mt-unsafe): main() calls this before there are other threads.
  mallopt(M_MMAP_THRESHOLD, 32 * kMebibyte);
  mallopt(M_TRIM_THRESHOLD, 64 * kMebibyte);
  // Each thread with a heap of its own would keep what it once took, and there are many more than
  // cores; so many that those who compute seldom wait for each other.
  mallopt(M_ARENA_MAX, static_cast<int>(std::thread::hardware_concurrency()) + 1);
  // NOLINTEND(concurrency-mt-unsafe)
}

void give_back_freed_memory() {
  malloc_trim(0);  // NOLINT(concurrency-mt-unsafe): its reads and writes are locked
}

}  // namespace loopscope::daemon
