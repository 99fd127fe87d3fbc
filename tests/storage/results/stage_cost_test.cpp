#include "storage/stage_cost.hpp"

#include <gtest/gtest.h>

#include "storage/results/results_database.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

class StageCostTest : public ResultsTest {};

/// Every member a number of its own.
constexpr StageCost kCost{.loops = 100,
                          .analysed = 90,
                          .modelled = 20,
                          .values = 12288,
                          .claim_s = 0.125,
                          .fetch_s = 0.25,
                          .prepare_s = 0.375,
                          .statistics_s = 0.5,
                          .model_s = 0.625,
                          .decide_s = 0.75,
                          .write_s = 0.875,
                          .wait_s = 1.0};

TEST_F(StageCostTest, LandsInItsOwnColumnsAndAddsUp) {
  ResultsDatabase results = connect();
  results.add_stage_cost({"host \"a\"", 3}, kCost);
  results.add_stage_cost({"host \"a\"", 3}, kCost);
  EXPECT_EQ(database->rows("SELECT host, lane, loops, analysed, modelled, sample_values, claim_s,"
                           " fetch_s, prepare_s, statistics_s, model_s, decide_s, write_s, wait_s"
                           " FROM loopscope.stage_cost"),
            (TextRows{{"host \"a\"", "3", "200", "180", "40", "24576", "0.25", "0.5", "0.75", "1",
                       "1.25", "1.5", "1.75", "2"}}));
  EXPECT_EQ(value("SELECT hour = date_trunc('hour', now()) FROM loopscope.stage_cost"), "t");
}

TEST_F(StageCostTest, TheViewTellsMillisecondsALoop) {
  ResultsDatabase results = connect();
  results.add_stage_cost({"a", 0}, kCost);
  results.add_stage_cost({"a", 1}, kCost);
  EXPECT_EQ(database->rows("SELECT host, lanes, loops, fetch_ms, model_ms, ms_per_model, wait_ms"
                           " FROM loopscope.stage_breakdown"),
            (TextRows{{"a", "2", "200", "2.5", "6.25", "31.25", "10"}}));
}

TEST_F(StageCostTest, OldHoursAreDroppedWithTheResults) {
  ResultsDatabase results = connect();
  results.add_stage_cost({"a", 0}, kCost);
  database->execute(
      "INSERT INTO loopscope.stage_cost SELECT hour - interval '3 years', host, lane,"
      " loops, analysed, modelled, sample_values, claim_s, fetch_s, prepare_s,"
      " statistics_s, model_s, decide_s, write_s, wait_s FROM loopscope.stage_cost");
  database->execute("SELECT loopscope.delete_old_rows(now() - interval '2 years')");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.stage_cost"), "1");
}

}  // namespace
}  // namespace loopscope::storage
