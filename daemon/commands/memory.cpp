#include "daemon/commands/memory.hpp"

#include <malloc.h>

namespace loopscope::daemon {

void keep_freed_memory() {
  constexpr int kMebibyte = 1024 * 1024;
  // Blocks above the first figure come from the kernel one by one; above the second at the end of
  // the heap goes back to it.
  // NOLINTBEGIN(concurrency-mt-unsafe): main() calls this before there are other threads.
  mallopt(M_MMAP_THRESHOLD, 32 * kMebibyte);
  mallopt(M_TRIM_THRESHOLD, 64 * kMebibyte);
  // NOLINTEND(concurrency-mt-unsafe)
}

}  // namespace loopscope::daemon
