#include "storage/results/session/results_clock.hpp"

#include <chrono>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

#include "storage/results/plant/plant_rounds.hpp"
#include "storage/results/schema/accept_clocks.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

class ResultsClockTest : public ResultsTest {};

void refuse(const ServerClock&) {
  throw DatabaseError("the clock is wrong", "set it", Remedy::retry);
}

TEST_F(ResultsClockTest, TheCheckIsToldTheTimeThatTheTransactionWritesWith) {
  add_loops({"a"});
  std::vector<ServerClock> told;
  ResultsDatabase results(settings_for(*database),
                          [&](const ServerClock& clock) { told.push_back(clock); });
  ASSERT_EQ(results.claim_due("me", 100, 1).size(), 1U);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(value("SELECT (extract(epoch FROM visible_at - interval '100 s') * 1000000)::bigint"
                  " FROM loopscope.schedule"),
            std::to_string(told[0].now_us));
  EXPECT_EQ(results.clock().started_us, told[0].started_us);
  EXPECT_GT(results.clock().now_us, told[0].now_us);
}

TEST_F(ResultsClockTest, NothingIsClaimedOrWrittenUnderAClockThatIsNotBelieved) {
  add_loops({"a", "b"});
  ResultsDatabase believing = connect();
  const std::vector<ClaimedLoop> claims = believing.claim_due("me", 100, 1);
  const auto rows = [&] {
    return database->rows("SELECT * FROM loopscope.schedule ORDER BY loop_id");
  };
  const TextRows before = rows();
  ResultsDatabase results(settings_for(*database), refuse);
  const std::vector<std::function<void()>> works{
      [&] { static_cast<void>(results.claim_due("you", 100, 5)); },
      [&] { static_cast<void>(results.claim_due("you", 100, 5, {"away"})); },
      [&] { static_cast<void>(results.claim_next("you", 100, 5, 0)); },
      [&] { static_cast<void>(results.claim_suspect("you", 100)); },
      [&] { results.finish(std::vector{completed(claims[0], slot(1), "d")}, {}); },
      [&] {
        results.finish({}, std::vector{FailedLoop{1, 1, "no rows"}});
      },
      [&] { results.release(claims); },
      [&] { results.release_owned("me"); },
      [&] { results.recall_stray(60); },
      [&] { static_cast<void>(results.extend(claims, 500)); },
      [&] {
        results.see_worker({"host/1", "1.0", 1, 0, 0});
      },
      [&] {
        results.add_stage_cost({"host", 0}, {});
      }};
  for (std::size_t k = 0; k < works.size(); ++k)
    EXPECT_THROW(works[k](), DatabaseError) << "number " << k;
  EXPECT_EQ(rows(), before);
  EXPECT_EQ(value("SELECT (SELECT count(*) FROM loopscope.worker)"
                  " + (SELECT count(*) FROM loopscope.stage_cost)"
                  " + (SELECT count(*) FROM loopscope.analysis)"),
            "0");
  EXPECT_EQ(results.count_enabled_loops(), 2U) << "to read is always allowed";
}

TEST_F(ResultsClockTest, NoPlantRoundUnderAClockThatIsNotBelieved) {
  PlantRounds rounds(settings_for(*database), refuse);
  EXPECT_THROW(static_cast<void>(rounds.take_turn(60, "host/1", 60)), DatabaseError);
  EXPECT_THROW(rounds.store({slot(1), 1, 30, 5, {}}), DatabaseError);
  EXPECT_THROW(rounds.announce_flags(), DatabaseError);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.plant_round"), "0");
}

TEST_F(ResultsClockTest, WhatAPersonAcceptsReplacesWhatWasAcceptedBefore) {
  database = database_of_owner();
  const ConnectionSettings owner = settings_for(*database);
  accept_clocks(owner, {{"host a", -18000.0}, {"historian b", 5.5}});
  accept_clocks(owner, {{"host a", 7200.0}});
  EXPECT_EQ(results_time(owner).accepted, (AcceptedClocks{{"host a", 7200.0}}));
  ResultsDatabase worker(settings_for(*database, database->make_login("loopscope_worker")));
  EXPECT_EQ(worker.accepted_clocks(), (AcceptedClocks{{"host a", 7200.0}}));
  EXPECT_NE(value("SELECT accepted_by FROM loopscope.accepted_clock"), "");
}

}  // namespace
}  // namespace loopscope::storage
