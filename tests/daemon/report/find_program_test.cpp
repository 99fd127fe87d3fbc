#include "daemon/report/find_program.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(FindProgram, LooksThroughThePathAndOnlyThere) {
  EXPECT_EQ(find_program("sh", "/nonexistent:/bin"), "/bin/sh");
  EXPECT_EQ(find_program("sh", ""), std::nullopt);
  EXPECT_EQ(find_program("sh", ":."), std::nullopt);
  EXPECT_EQ(find_program("no-such-program", "/bin:/usr/bin"), std::nullopt);
}

}  // namespace
}  // namespace loopscope::daemon
