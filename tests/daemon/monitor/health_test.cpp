#include "daemon/monitor/health.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

class HealthTest : public testing::Test {
 protected:
  void pass(double seconds) {
    now +=
        std::chrono::duration_cast<Health::Clock::duration>(std::chrono::duration<double>(seconds));
  }

  std::optional<std::string> standing_still;
  Health::Clock::time_point now = Health::Clock::now();
  Health health{[this] { return standing_still; }, {60.0, 3600.0}, [this] { return now; }};
};

TEST_F(HealthTest, LiveUntilAThreadStandsStill) {
  EXPECT_TRUE(health.live().well);
  EXPECT_EQ(health.live().text, "ok\n");
  EXPECT_EQ(health.live().http_status(), 200);
  standing_still = "worker 3 has not advanced for 400 s\nREADY";
  EXPECT_FALSE(health.live().well);
  EXPECT_EQ(health.live().http_status(), 503);
  EXPECT_EQ(health.live().text, "worker 3 has not advanced for 400 s READY\n");
}

TEST_F(HealthTest, NotReadyBeforeTheDatabaseHasAnswered) {
  EXPECT_EQ(health.ready().text, "results database: not reached since the start\n");
  EXPECT_EQ(health.ready().http_status(), 503);
  health.results_answered();
  EXPECT_EQ(health.ready().text, "ok\n");
  EXPECT_EQ(health.ready().http_status(), 200);
}

TEST_F(HealthTest, DatabaseThatIsAwayMakesItNotReadyButLive) {
  health.results_answered();
  pass(60.0);
  EXPECT_TRUE(health.ready().well);
  pass(30.0);
  EXPECT_EQ(health.ready().text, "results database: no answer for 90 s, at most 60 s\n");
  EXPECT_TRUE(health.live().well);
  health.results_answered();
  EXPECT_TRUE(health.ready().well);
}

TEST_F(HealthTest, ForeignSchemaStandsUntilItIsThisPrograms) {
  health.schema_refused("has version 13, this program needs 12");
  EXPECT_EQ(health.ready().text, "schema: has version 13, this program needs 12\n");
  health.results_answered();
  EXPECT_TRUE(health.ready().well);
}

TEST_F(HealthTest, LagUpToTheLimitIsReady) {
  health.results_answered();
  health.set(storage::ScheduleHealth{.lag_s = 3600.0});
  EXPECT_TRUE(health.ready().well);
  health.set(storage::ScheduleHealth{.lag_s = 4000.0});
  EXPECT_EQ(health.ready().text, "lag: the most overdue loop waits for 4000 s, at most 3600 s\n");
  health.set_limits({60.0, 5000.0});
  EXPECT_TRUE(health.ready().well);
}

TEST_F(HealthTest, EveryReasonHasALineOfItsOwn) {
  health.schema_refused("has version 13");
  health.set(storage::ScheduleHealth{.lag_s = 4000.0});
  pass(61.0);
  const std::string text = health.ready().text;
  EXPECT_EQ(std::ranges::count(text, '\n'), 3);
  EXPECT_THAT(text, HasSubstr("results database: no answer for 61 s"));
  EXPECT_THAT(text, HasSubstr("schema: "));
  EXPECT_THAT(text, HasSubstr("lag: "));
}

TEST(HealthOfThreads, IsTouchedByManyAtOnce) {
  Health health([] { return std::nullopt; }, {60.0, 3600.0});
  std::vector<std::jthread> threads;
  for (int number = 0; number < 4; ++number) {
    threads.emplace_back([&health] {
      for (int round = 0; round < 1000; ++round) {
        health.results_answered();
        health.set(storage::ScheduleHealth{.lag_s = 1.0});
        EXPECT_TRUE(health.ready().well);
        EXPECT_TRUE(health.live().well);
      }
    });
  }
}

}  // namespace
}  // namespace loopscope::daemon
