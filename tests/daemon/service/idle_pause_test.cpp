#include "daemon/service/idle_pause.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using testing::AllOf;
using testing::Ge;
using testing::Le;

constexpr double kPoll_s = 10.0;

TEST(IdlePause, EndsWhenTheNextLoopFallsDueOrAfterAPoll) {
  RetryPause pause(kPoll_s);
  for (int k = 0; k < 100; ++k) {
    EXPECT_THAT(idle_pause_s({.next_due_in_s = 3.0}, kPoll_s, {}, pause), AllOf(Ge(3.0), Le(3.05)));
    EXPECT_EQ(idle_pause_s({.next_due_in_s = 3600.0}, kPoll_s, {}, pause), kPoll_s);
  }
}

TEST(IdlePause, GrowsWhileSomethingIsDueThatCannotBeClaimed) {
  RetryPause pause(kPoll_s);
  double sum_s = 0.0;
  for (int look = 0; look < 20; ++look) sum_s += idle_pause_s({}, kPoll_s, {}, pause);
  EXPECT_GT(sum_s, 60.0) << "not eight times a second";
  EXPECT_LE(idle_pause_s({.worked = true}, kPoll_s, {}, pause), 0.25) << "work begins it anew";
}

TEST(IdlePause, ASourceThatMayBeTriedAgainIsNotKeptWaiting) {
  RetryPause pause(kPoll_s);
  for (int look = 0; look < 20; ++look) {
    EXPECT_LE(idle_pause_s({}, kPoll_s, 1.0, pause), 1.05);
    EXPECT_LE(idle_pause_s({}, kPoll_s, 0.0, pause), 0.15);
  }
}

TEST(IdlePause, GrowsAfterFaultsWhateverIsDue) {
  RetryPause pause(kPoll_s);
  double last_s = 0.0;
  for (int look = 0; look < 10; ++look) {
    last_s =
        idle_pause_s({.failed = true, .worked = true, .next_due_in_s = 1.0}, kPoll_s, {}, pause);
  }
  EXPECT_GE(last_s, 5.0);
}

}  // namespace
}  // namespace loopscope::daemon
