#include "daemon/monitor/oldest_snapshot.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(OldestSnapshotTest, AgesWhileItIsTheSame) {
  using std::chrono::seconds;
  OldestSnapshot snapshot;
  const OldestSnapshot::Clock::time_point start;
  EXPECT_EQ(snapshot.seconds_kept("731", start), 0.0);
  EXPECT_EQ(snapshot.seconds_kept("731", start + seconds(60)), 60.0);
  EXPECT_EQ(snapshot.seconds_kept("732", start + seconds(90)), 0.0) << "another is a younger one";
  EXPECT_EQ(snapshot.seconds_kept("", start + seconds(120)), 0.0);
  EXPECT_EQ(snapshot.seconds_kept("", start + seconds(180)), 0.0);
  EXPECT_EQ(snapshot.seconds_kept("732", start + seconds(240)), 0.0);
}

}  // namespace
}  // namespace loopscope::daemon
