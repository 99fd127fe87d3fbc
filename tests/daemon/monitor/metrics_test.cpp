#include "daemon/monitor/metrics.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "storage/utf8.hpp"
#include "tests/daemon/monitor/exposition.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::Key;
using testing::Not;
using testing::Pair;
using testing::UnorderedElementsAre;

class MetricsTest : public testing::Test {
 protected:
  [[nodiscard]] std::map<std::string, double> samples() const {
    return read_exposition(metrics.text()).samples;
  }
  [[nodiscard]] double value(const std::string& name) const {
    const auto all = samples();
    const auto found = all.find(name);
    return found == all.end() ? std::nan("") : found->second;
  }

  Metrics metrics{{"0.1.0", 8, "avx2"}};
};

/// Everything that there is, each at least once.
void fill(Metrics& metrics) {
  metrics.set_sources(std::vector<std::string>{"plant"});
  metrics.observe_batch(0.2);
  metrics.data_age("plant", 12.5);
  metrics.set(storage::ScheduleHealth{100, 7, 42.5, 3, 2, 5}, 24);
  metrics.set(storage::PlantFigures{{{.area = "a", .control_sum = 0.5, .control_loops = 1}},
                                    {{"valve_stiction", 1}}});
  metrics.since_progress(1.5);
  metrics.kept_windows(2, 100'000);
}

TEST_F(MetricsTest, HasExactlyTheNamesOfTheRunbook) {
  fill(metrics);
  EXPECT_THAT(
      read_exposition(metrics.text()).types,
      UnorderedElementsAre(
          Pair("loopscope_build_info", "gauge"), Pair("loopscope_start_time_seconds", "gauge"),
          Pair("loopscope_loops_total", "counter"),
          Pair("loopscope_stage_seconds_total", "counter"),
          Pair("loopscope_batch_seconds", "histogram"),
          Pair("loopscope_sample_values_total", "counter"),
          Pair("loopscope_enabled_loops", "gauge"), Pair("loopscope_overdue_loops", "gauge"),
          Pair("loopscope_lag_seconds", "gauge"), Pair("loopscope_failing_loops", "gauge"),
          Pair("loopscope_data_age_seconds", "gauge"),
          Pair("loopscope_leases_lost_total", "counter"),
          Pair("loopscope_reconnects_total", "counter"), Pair("loopscope_faults_total", "counter"),
          Pair("loopscope_fault_standing", "gauge"),
          Pair("loopscope_unknown_quality_total", "counter"),
          Pair("loopscope_kept_windows", "gauge"), Pair("loopscope_kept_windows_bytes", "gauge"),
          Pair("loopscope_settings_reload_success", "gauge"),
          Pair("loopscope_seconds_since_progress", "gauge"),
          Pair("loopscope_partition_months_ahead", "gauge"),
          Pair("loopscope_default_partition_rows", "gauge"),
          Pair("loopscope_oldest_partition_months", "gauge"),
          Pair("loopscope_oldest_snapshot_seconds", "gauge"),
          Pair("loopscope_retention_months", "gauge"), Pair("loopscope_flagged_loops", "gauge"),
          Pair("loopscope_loops_by_state", "gauge"), Pair("loopscope_service_factor", "gauge"),
          Pair("loopscope_flags_total", "counter")));
}

TEST_F(MetricsTest, BeginsAtZeroWhereSomethingIsCountedAndSaysNothingThatItDoesNotKnow) {
  const std::vector<std::string> sources{"plant"};
  metrics.set_sources(sources);
  const auto all = samples();
  for (const char* name :
       {R"(loopscope_loops_total{result="new"})", R"(loopscope_loops_total{result="set_aside"})",
        R"(loopscope_stage_seconds_total{stage="wait"})", "loopscope_sample_values_total",
        "loopscope_leases_lost_total", R"(loopscope_reconnects_total{target="results"})",
        R"(loopscope_reconnects_total{target="historian plant"})",
        R"(loopscope_faults_total{subject="results database"})",
        R"(loopscope_fault_standing{subject="historian plant"})",
        R"(loopscope_unknown_quality_total{source="plant"})"}) {
    EXPECT_THAT(all, Contains(Pair(name, 0.0)));
  }
  EXPECT_THAT(metrics.text(), Not(HasSubstr("loopscope_lag_seconds")));
  EXPECT_THAT(metrics.text(), Not(HasSubstr("loopscope_data_age_seconds")));
  EXPECT_EQ(value("loopscope_settings_reload_success"), 1.0);
}

TEST_F(MetricsTest, CountsLoopsByWhatCameOfThem) {
  for (int round = 0; round < 2; ++round) {
    metrics.count(storage::WriteCount{.inserted = 1,
                                      .revised = 2,
                                      .unchanged = 3,
                                      .failed = 4,
                                      .fenced_off = 5,
                                      .not_judged = 6});
  }
  const auto all = samples();
  for (const auto& [result, loops] :
       {std::pair{"new", 2.0}, std::pair{"revised", 4.0}, std::pair{"unchanged", 6.0},
        std::pair{"set_aside", 8.0}, std::pair{"fenced_off", 10.0}, std::pair{"not_judged", 12.0}})
    EXPECT_THAT(all, Contains(Pair("loopscope_loops_total{result=\"" + std::string(result) + "\"}",
                                   loops)));
}

TEST_F(MetricsTest, AddsTheTimeOfEveryStage) {
  const storage::StageCost cost{.loops = 1,
                                .analysed = 2,
                                .modelled = 3,
                                .values = 4096,
                                .claim_s = 0.125,
                                .fetch_s = 0.25,
                                .prepare_s = 0.375,
                                .statistics_s = 0.5,
                                .model_s = 0.625,
                                .decide_s = 0.75,
                                .write_s = 0.875,
                                .wait_s = 1.0};
  metrics.add(cost);
  metrics.add(cost);
  const auto all = samples();
  double expected = 0.25;
  for (const char* stage :
       {"claim", "fetch", "prepare", "statistics", "model", "decide", "write", "wait"}) {
    EXPECT_THAT(all,
                Contains(Pair("loopscope_stage_seconds_total{stage=\"" + std::string(stage) + "\"}",
                              expected)));
    expected += 0.25;
  }
  EXPECT_EQ(value("loopscope_sample_values_total"), 8192.0);
}

TEST_F(MetricsTest, SortsBatchesByTheirTime) {
  for (const double seconds : {0.01, 0.2, 4.0, 1000.0}) metrics.observe_batch(seconds);
  EXPECT_EQ(value(R"(loopscope_batch_seconds_bucket{le="0.05"})"), 1.0);
  EXPECT_EQ(value(R"(loopscope_batch_seconds_bucket{le="0.25"})"), 2.0);
  EXPECT_EQ(value(R"(loopscope_batch_seconds_bucket{le="300"})"), 3.0);
  EXPECT_EQ(value(R"(loopscope_batch_seconds_bucket{le="+Inf"})"), 4.0);
  EXPECT_EQ(value("loopscope_batch_seconds_count"), 4.0);
  EXPECT_DOUBLE_EQ(value("loopscope_batch_seconds_sum"), 1004.21);
}

TEST_F(MetricsTest, FaultCountsWhenItBegins) {
  const std::string standing = R"(loopscope_fault_standing{subject="historian plant"})";
  const std::string total = R"(loopscope_faults_total{subject="historian plant"})";
  for (int worker = 0; worker < 5; ++worker) metrics.fault("historian plant");
  EXPECT_EQ(value(standing), 1.0);
  EXPECT_EQ(value(total), 1.0);
  metrics.recovered("historian plant");
  metrics.recovered("historian plant");
  EXPECT_EQ(value(standing), 0.0);
  metrics.fault("historian plant");
  EXPECT_EQ(value(total), 2.0);
}

TEST_F(MetricsTest, TellsTheStateOfTheSchedule) {
  metrics.set(storage::ScheduleHealth{100'000, 7, 42.5, 3, -1, 10'001, 25}, 24);
  EXPECT_EQ(value("loopscope_enabled_loops"), 100'000.0);
  EXPECT_EQ(value("loopscope_overdue_loops"), 7.0);
  EXPECT_EQ(value("loopscope_lag_seconds"), 42.5);
  EXPECT_EQ(value("loopscope_failing_loops"), 3.0);
  EXPECT_EQ(value("loopscope_partition_months_ahead"), -1.0);
  EXPECT_EQ(value("loopscope_default_partition_rows"), 10'001.0);
  EXPECT_EQ(value("loopscope_oldest_partition_months"), 25.0);
  EXPECT_EQ(value("loopscope_retention_months"), 24.0);
}

TEST_F(MetricsTest, RememberTheRest) {
  metrics.leases_lost(3);
  metrics.leases_lost(2);
  metrics.reconnected("results");
  metrics.settings_reload(false);
  metrics.since_progress(12.5);
  metrics.unknown_quality("plant", 40);
  EXPECT_EQ(value("loopscope_leases_lost_total"), 5.0);
  EXPECT_EQ(value(R"(loopscope_reconnects_total{target="results"})"), 1.0);
  EXPECT_EQ(value("loopscope_settings_reload_success"), 0.0);
  EXPECT_EQ(value("loopscope_seconds_since_progress"), 12.5);
  EXPECT_EQ(value(R"(loopscope_unknown_quality_total{source="plant"})"), 40.0);
}

TEST_F(MetricsTest, AgeOfAHistorianThatIsNoLongerInTheSettingsIsForgotten) {
  metrics.data_age("old", 5.0);
  metrics.data_age("plant\n", 6.0);
  metrics.set_sources(std::vector<std::string>{"plant\n"});
  const auto all = samples();
  EXPECT_THAT(
      all, Contains(Pair(R"(loopscope_data_age_seconds{source="plant "})", DoubleNear(6.0, 1.0))));
  EXPECT_THAT(all, Not(Contains(Key(R"(loopscope_data_age_seconds{source="old"})"))));
}

TEST_F(MetricsTest, TheNewestRowThatWasEverSeenTellsTheAgeOfAHistorian) {
  metrics.set_sources(std::vector<std::string>{"plant"});
  for (const double age_s : {500.0, 6.0, 90000.0}) metrics.data_age("plant", age_s);
  EXPECT_THAT(samples(),
              Contains(Pair(R"(loopscope_data_age_seconds{source="plant"})", DoubleNear(6.0, 1.0))))
      << "a dead tag does not make a historian old";
}

TEST_F(MetricsTest, HostileNamesStayLabelsOfOneLine) {
  using namespace std::string_literals;
  const std::vector<std::string> names{"a\"} 1\nloopscope_lag_seconds 1e9",
                                       "\\",
                                       "\"",
                                       "a\\n",
                                       "",
                                       "\xff\xfe",
                                       "a\0b"s,
                                       "{}",
                                       "\r\n",
                                       std::string(5000, 'x'),
                                       "\u2028\u202e"};
  const std::size_t before = samples().size();
  for (const std::string& name : names) metrics.data_age(name, 1.0);
  const std::string text = metrics.text();
  EXPECT_TRUE(storage::is_storable(text)) << "one odd byte costs the whole scrape";
  const auto all = read_exposition(text).samples;
  EXPECT_EQ(all.size(), before + names.size());
  EXPECT_THAT(all, Not(Contains(Key("loopscope_lag_seconds"))));
  EXPECT_THAT(
      all,
      Contains(Key(R"(loopscope_data_age_seconds{source="a\"} 1 loopscope_lag_seconds 1e9"})")));
  EXPECT_LT(text.size(), 20'000U);
}

TEST_F(MetricsTest, NumberOfNamesIsBounded) {
  for (int number = 0; number < 10'000; ++number) {
    metrics.fault("loop " + std::to_string(number));
    metrics.unknown_quality("source " + std::to_string(number), 1);
  }
  EXPECT_LT(samples().size(), 300U);
  // Two subjects or sources are known before, 64 in all; the others share one.
  EXPECT_EQ(value(R"(loopscope_unknown_quality_total{source="other"})"), 10'000.0 - 64.0);
  EXPECT_EQ(value(R"(loopscope_fault_standing{subject="other"})"), 1.0);
}

TEST_F(MetricsTest, LoseNothingBetweenThreads) {
  constexpr int kThreads = 4;
  constexpr int kRounds = 500;
  std::vector<std::jthread> threads;
  for (int number = 0; number < kThreads; ++number) {
    threads.emplace_back([this, number] {
      for (int round = 0; round < kRounds; ++round) {
        metrics.count(storage::WriteCount{.inserted = 1});
        metrics.add(storage::StageCost{.values = 2, .fetch_s = 0.5});
        metrics.observe_batch(0.2);
        metrics.reconnected("historian " + std::to_string(round % 8));
        metrics.fault("of thread " + std::to_string(number));
        metrics.recovered("of thread " + std::to_string(number));
        metrics.set_sources(std::vector<std::string>{"plant"});
        metrics.data_age(round % 2 == 0 ? "plant" : "old", 1.0);
        if (round % 50 == 0) {
          EXPECT_NO_THROW(static_cast<void>(read_exposition(metrics.text())));
        }
      }
    });
  }
  threads.clear();
  constexpr double kAll = kThreads * kRounds;
  EXPECT_EQ(value(R"(loopscope_loops_total{result="new"})"), kAll);
  EXPECT_EQ(value("loopscope_sample_values_total"), 2.0 * kAll);
  EXPECT_EQ(value(R"(loopscope_stage_seconds_total{stage="fetch"})"), 0.5 * kAll);
  EXPECT_EQ(value("loopscope_batch_seconds_count"), kAll);
  EXPECT_EQ(value(R"(loopscope_faults_total{subject="of thread 1"})"), kRounds);
}

/// The text as Prometheus' own reader takes it, and its advice on names.
TEST_F(MetricsTest, PleasePrometheus) {
  std::string promtool = "/usr/bin/promtool";
  if (!std::filesystem::exists(promtool)) promtool = tests::source_dir() / "build/tools/promtool";
  if (!std::filesystem::exists(promtool))
    GTEST_SKIP() << "no promtool, also in " << promtool
                 << ", which deploy/test takes out of Debian's package prometheus";
  fill(metrics);
  metrics.data_age("a\"b\\c\nd\xff", 1.0);
  const std::string file =
      std::filesystem::temp_directory_path() / ("loopscope_metrics_" + std::to_string(getpid()));
  std::ofstream(file) << metrics.text();
  const auto result =
      tests::run_program({"/bin/sh", "-c", "exec \"$0\" check metrics < \"$1\"", promtool, file});
  std::filesystem::remove(file);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(result.err, "");
}

}  // namespace
}  // namespace loopscope::daemon
