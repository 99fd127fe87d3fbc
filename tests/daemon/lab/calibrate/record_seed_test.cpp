#include "daemon/lab/calibrate/record_seed.hpp"

#include <gtest/gtest.h>
#include <set>
#include <string>

namespace loopscope::daemon {
namespace {

TEST(RecordSeed, EveryRecordHasItsOwn) {
  std::set<std::uint64_t> seeds;
  for (const std::string stream : {"white", "ar1_0.9", "plant/white", ""}) {
    for (std::uint64_t index = 0; index < 10'000; ++index) {
      seeds.insert(record_seed(stream, index));
    }
  }
  EXPECT_EQ(seeds.size(), 40'000U);
}

TEST(RecordSeed, IsTheSameEveryTime) {
  EXPECT_EQ(record_seed("white", 7), record_seed("white", 7));
}

}  // namespace
}  // namespace loopscope::daemon
