#include "daemon/service/threads/memory.hpp"

#include <cstddef>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>
#include <vector>

// Builds with sanitizers keep freed memory for a while, to see who uses it still.
#ifdef LOOPSCOPE_TCMALLOC

namespace loopscope::daemon {
namespace {

double resident_mb() {
  std::size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

TEST(Memory, FreedBlocksAreKeptAndGivenBack) {
  bound_thread_caches();
  give_back_freed_memory();
  const double before_mb = resident_mb();
  // As many as a batch's windows: 100 MB.
  std::vector<std::vector<double>> windows(1000, std::vector<double>(12'500, 1.0));
  windows.clear();
  const double kept_mb = resident_mb() - before_mb;
  give_back_freed_memory();
  EXPECT_GT(kept_mb, 80.0);
  EXPECT_LT(resident_mb() - before_mb, 10.0);
}

}  // namespace
}  // namespace loopscope::daemon

#endif
