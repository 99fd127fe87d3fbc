#include "daemon/service/threads/pauses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>
#include <thread>

namespace loopscope::daemon {
namespace {

using testing::AllOf;
using testing::Ge;
using testing::Le;

using namespace std::chrono_literals;

TEST(SleepFor, WithoutAStopAPauseIsWhole) {
  const std::stop_source source;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(sleep_for(source.get_token(), 20ms));
  EXPECT_TRUE(sleep_for({}, 20ms)) << "where nobody can request one";
  EXPECT_GE(std::chrono::steady_clock::now() - start, 40ms);
}

TEST(SleepFor, AStopEndsEveryPauseAtOnceAndEveryLaterOne) {
  std::stop_source source;
  const std::jthread other([&] { EXPECT_FALSE(sleep_for(source.get_token(), 1h)); });
  const std::jthread stopper([&] {
    std::this_thread::sleep_for(20ms);
    source.request_stop();
  });
  EXPECT_FALSE(sleep_for(source.get_token(), 1h));
  EXPECT_FALSE(sleep_for(source.get_token(), 1h));
}

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
