#include "daemon/service/threads/retry_pause.hpp"

#include <gtest/gtest.h>
#include <set>

namespace loopscope::daemon {
namespace {

TEST(RetryPause, DoublesUpToTheLongestWithJitter) {
  RetryPause pause(2.0);
  for (const double whole_s : {0.25, 0.5, 1.0, 2.0, 2.0, 2.0}) {
    const double pause_s = pause.next_s();
    EXPECT_GE(pause_s, 0.5 * whole_s);
    EXPECT_LE(pause_s, whole_s);
  }
  pause.reset();
  EXPECT_LE(pause.next_s(), 0.25);
}

TEST(RetryPause, NeverExceedsAShortPoll) {
  RetryPause pause(0.1);
  for (int k = 0; k < 50; ++k) EXPECT_LE(pause.next_s(), 0.1);
}

TEST(RetryPause, WorkersDoNotComeBackInStep) {
  std::set<double> pauses_s;
  for (int worker = 0; worker < 50; ++worker) pauses_s.insert(RetryPause(10.0).next_s());
  EXPECT_GT(pauses_s.size(), 40u);
}

}  // namespace
}  // namespace loopscope::daemon
