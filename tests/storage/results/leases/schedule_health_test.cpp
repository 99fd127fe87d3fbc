#include "storage/results/leases/schedule_health.hpp"

#include <algorithm>
#include <chrono>
#include <gmock/gmock.h>
#include <iostream>

#include "storage/results/schema/migrate.hpp"
#include "storage/results/session/session.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

class ScheduleHealthTest : public ResultsTest {
 protected:
  [[nodiscard]] ScheduleHealth look() const {
    Session session(settings_for(*database));
    return schedule_health(session);
  }
};

TEST_F(ScheduleHealthTest, EmptyCatalogueIsWell) {
  const ScheduleHealth health = look();
  EXPECT_EQ(health.enabled_loops, 0);
  EXPECT_EQ(health.overdue_loops, 0);
  EXPECT_EQ(health.lag_s, 0.0);
  EXPECT_EQ(health.failing_loops, 0);
  EXPECT_EQ(health.default_partition_rows, 0);
}

TEST_F(ScheduleHealthTest, WhoIsDueAndHeldByNobodyIsOverdue) {
  add_loops({"early", "late", "future", "disabled"});
  database->execute(
      "UPDATE loopscope.schedule SET visible_at = now() - interval '90 s' WHERE loop_id = 1;"
      "UPDATE loopscope.schedule SET visible_at = now() - interval '1 hour' WHERE loop_id = 2;"
      "UPDATE loopscope.schedule SET visible_at = now() + interval '1 hour' WHERE loop_id = 3;"
      "UPDATE loopscope.schedule SET visible_at = now() - interval '9 days' WHERE loop_id = 4;"
      "UPDATE loopscope.loop SET enabled = false WHERE name = 'disabled'");
  const ScheduleHealth health = look();
  EXPECT_EQ(health.enabled_loops, 3);
  EXPECT_EQ(health.overdue_loops, 2);
  EXPECT_GE(health.lag_s, 3600.0);
  EXPECT_LT(health.lag_s, 3700.0);
}

TEST_F(ScheduleHealthTest, LivingLeaseIsNotOverdueAndALostOneIs) {
  add_loops({"a", "b"});
  ResultsDatabase results = connect();
  ASSERT_EQ(claim_all(results).size(), 2U);
  EXPECT_EQ(look().overdue_loops, 0);
  EXPECT_EQ(look().lag_s, 0.0);
  database->execute(
      "UPDATE loopscope.schedule SET visible_at = now() - interval '5 s' WHERE loop_id = 1");
  EXPECT_EQ(look().overdue_loops, 1);
  EXPECT_GE(look().lag_s, 5.0);
}

TEST_F(ScheduleHealthTest, CountsWhoFailsUntilItSucceeds) {
  add_loops({"a", "b", "c"});
  ResultsDatabase results = connect();
  const auto claimed = claim_all(results);
  const std::vector<FailedLoop> failed{{claimed[0].loop.loop_id, claimed[0].fence, "x", 0.0},
                                       {claimed[1].loop.loop_id, claimed[1].fence, "x", 60.0}};
  results.finish({}, failed);
  EXPECT_EQ(look().failing_loops, 2);
  EXPECT_EQ(look().overdue_loops, 1) << "a loop that pauses after a failure is not overdue";
  const auto again = claim_all(results);
  ASSERT_EQ(again.size(), 1U);
  results.finish(std::vector{completed(again[0], slot(1), "d")}, {});
  EXPECT_EQ(look().failing_loops, 1);
}

TEST_F(ScheduleHealthTest, CountsMonthsAheadUpToTheFirstGap) {
  const int made = look().partition_months_ahead;
  EXPECT_GE(made, 1) << "migrate makes months ahead";
  database->execute("SELECT loopscope.make_partitions(now(), 7)");
  EXPECT_EQ(look().partition_months_ahead, std::max(made, 6));
  const auto drop = [&](const std::string& table, int months) {
    database->execute("DO $$ BEGIN PERFORM loopscope.drop_partition('" + table +
                      "' || to_char((now() AT TIME ZONE 'UTC') + interval '" +
                      std::to_string(months) + " months', '_YYYY_MM')); END $$");
  };
  drop("verdict", 3);
  EXPECT_EQ(look().partition_months_ahead, 2) << "every table counts";
  drop("explanation_step", 0);
  EXPECT_EQ(look().partition_months_ahead, -1);
  database->execute("SELECT loopscope.make_partitions(now(), 40)");
  EXPECT_EQ(look().partition_months_ahead, 24) << "no further does it look";
}

TEST_F(ScheduleHealthTest, CountsMonthsBackToTheOldestPartition) {
  EXPECT_EQ(look().oldest_partition_months, 0);
  database->execute(
      "SELECT loopscope.make_partition('verdict', ((date_trunc('month', now() AT TIME ZONE 'UTC')"
      " - interval '27 months') AT TIME ZONE 'UTC')::date)");
  EXPECT_EQ(look().oldest_partition_months, 27);
  maintain(settings_for(*database), {.retention_months = 24});
  EXPECT_EQ(look().oldest_partition_months, 0);
}

TEST_F(ScheduleHealthTest, CountsRowsWithoutAMonthUpToABound) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  const auto claimed = claim_all(results);
  constexpr int kHoursToAYearWithoutPartition = -24 * 365 * 40;
  results.finish(std::vector{completed(claimed[0], slot(kHoursToAYearWithoutPartition), "d")}, {});
  // The analysis, its verdict and its two peaks.
  EXPECT_EQ(look().default_partition_rows, 4);
  database->execute(
      "INSERT INTO loopscope.bicoherence_peak_default SELECT p.loop_id, p.slot_end,"
      " p.algorithm_revision, p.input_revision, 1000 + n, p.f1, p.f2, p.bic2, p.p"
      " FROM loopscope.bicoherence_peak_default AS p, generate_series(1, 20000) AS n"
      " WHERE p.rank = 1");
  EXPECT_EQ(look().default_partition_rows, kMostDefaultRows);
}

TEST_F(ScheduleHealthTest, WorkerMayAsk) {
  database->make_roles();
  const std::string worker = database->make_login("loopscope_worker");
  migrate(settings_for(*database));
  Session session(settings_for(*database, worker));
  EXPECT_EQ(schedule_health(session).enabled_loops, 0);
}

/// The best of some looks, so that a busy machine does not decide. The figure is printed.
TEST_F(ScheduleHealthTest, OneLookAtAHundredThousandLoopsTakesLessThanATenthOfASecond) {
  constexpr int kLoops = 100'000;
  database->execute(
      "INSERT INTO loopscope.loop (name, source, pv_tag, period_s)"
      " SELECT 'L' || n, 'plant', 'T' || n, 3600 FROM generate_series(1, " +
      std::to_string(kLoops) +
      ") AS n;"
      "UPDATE loopscope.schedule SET visible_at = now() + (loop_id % 3600 - 30) * interval '1 s',"
      " attempts = (loop_id % 100 = 0)::integer");
  Session session(settings_for(*database));
  std::vector<double> milliseconds;
  for (int round = 0; round < 11; ++round) {
    const auto start = std::chrono::steady_clock::now();
    const ScheduleHealth health = schedule_health(session);
    milliseconds.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
            .count());
    EXPECT_EQ(health.enabled_loops, kLoops);
    EXPECT_EQ(health.failing_loops, kLoops / 100);
    EXPECT_GT(health.overdue_loops, 0);
  }
  std::ranges::sort(milliseconds);
  std::cout << "one look: best " << milliseconds.front() << " ms, median " << milliseconds[5]
            << " ms, worst " << milliseconds.back() << " ms\n";
  EXPECT_LT(milliseconds.front(), 100.0);
}

}  // namespace
}  // namespace loopscope::storage
