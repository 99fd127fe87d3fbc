#include "core/diagnosis/seed.hpp"

#include <gtest/gtest.h>
#include <set>

namespace loopscope::core {
namespace {

TEST(Seed, IsTheSameForTheSameLoopAndTime) {
  EXPECT_EQ(seed_of("FIC101", 1'700'000'000'000'000), seed_of("FIC101", 1'700'000'000'000'000));
  EXPECT_EQ(seed_of("", 0), 0xa8c7f832281a39c5U);  // FNV-1a of eight zero bytes
}

TEST(Seed, DiffersBetweenLoopsAndBetweenSlots) {
  std::set<std::uint64_t> seeds;
  for (int loop = 0; loop < 100; ++loop) {
    for (int slot = 0; slot < 100; ++slot) {
      seeds.insert(seed_of("LOOP" + std::to_string(loop), 1'000'000LL * slot));
    }
  }
  EXPECT_EQ(seeds.size(), 10'000U);
}

}  // namespace
}  // namespace loopscope::core
