#include "daemon/service/threads/memory.hpp"

#ifdef LOOPSCOPE_TCMALLOC

#include <cstddef>
#include <gperftools/malloc_extension.h>

namespace loopscope::daemon {

void bound_thread_caches() {
  // Of all threads together: four workers' blocks of one analysis. By itself it would be 32 MB.
  constexpr std::size_t kThreadCaches = std::size_t{16} * 1024 * 1024;
  MallocExtension::instance()->SetNumericProperty("tcmalloc.max_total_thread_cache_bytes",
                                                  kThreadCaches);
}

void give_back_freed_memory() {
  MallocExtension::instance()->ReleaseFreeMemory();
}

}  // namespace loopscope::daemon

#else

namespace loopscope::daemon {

void bound_thread_caches() {}

void give_back_freed_memory() {}

}  // namespace loopscope::daemon

#endif
