#include "daemon/service/threads/memory.hpp"

#include <gtest/gtest.h>
#include <malloc.h>
#include <memory>

namespace loopscope::daemon {
namespace {

TEST(Memory, BlocksOfAnAnalysisComeFromTheHeap) {
  keep_freed_memory();
  constexpr std::size_t kDoubles = 100'000;
  const std::size_t mapped = mallinfo2().hblks;
  const auto block = std::make_unique<double[]>(kDoubles);
  block[0] = 1.0;
  EXPECT_EQ(mallinfo2().hblks, mapped);
}

}  // namespace
}  // namespace loopscope::daemon
