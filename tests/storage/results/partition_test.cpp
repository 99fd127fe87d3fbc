#include <gmock/gmock.h>
#include <thread>

#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class PartitionTest : public ResultsTest {
 protected:
  /// An analysis of loop `loop_id` with its verdict in the month of `slot_end`.
  void store(const std::string& loop, const std::string& slot_end) {
    database->execute("INSERT INTO loopscope.verdict SELECT loop_id, '" + slot_end +
                      "', 1, 1, 1, 'healthy', 1,"
                      " '', '{}', '' FROM loopscope.loop WHERE name = '" +
                      loop + "'");
  }
  /// `slot_end` as SQL.
  void store_analysis(const std::string& slot_end) {
    database->execute(
        "INSERT INTO loopscope.analysis (loop_id, slot_end, algorithm_revision, fence,"
        " program_version, settings, input_digest, fetch_ms, analyse_ms, window_start, window_end,"
        " samples, interval_s, usable, oscillating, flags)"
        " SELECT loop_id, at.time, 1, 1, '', '{}', 'd', 0, 0, at.time, at.time, 0, 1, false, "
        "false, '{}'"
        " FROM loopscope.loop, (SELECT (" +
        slot_end + ")::timestamptz) AS at (time)");
  }
  [[nodiscard]] std::string where(const std::string& slot_end) const {
    return value("SELECT tableoid::regclass FROM loopscope.verdict WHERE slot_end = '" + slot_end +
                 "'");
  }
};

TEST_F(PartitionTest, ThisMonthAndThreeMoreAreThere) {
  EXPECT_EQ(value("SELECT count(*) FROM pg_inherits"
                  " WHERE inhparent = 'loopscope.analysis'::regclass"),
            "5");
  EXPECT_EQ(value("SELECT to_regclass('loopscope.verdict_' ||"
                  " to_char(date_trunc('month', now() AT TIME ZONE 'UTC') + interval '3 months',"
                  " 'YYYY_MM')) IS NOT NULL"),
            "t");
  EXPECT_THAT(maintain(settings_for(*database), {}).created, IsEmpty());
}

TEST_F(PartitionTest, RowsOfAMonthWithoutPartitionMoveWhenItIsMade) {
  add_loops({"a"});
  store("a", "2020-02-01 00:00:00+00");
  store("a", "2020-02-29 23:59:59.999999+00");
  store("a", "2020-03-01 00:00:00+00");
  EXPECT_EQ(where("2020-02-01 00:00:00+00"), "loopscope.verdict_default");
  EXPECT_EQ(database->rows("SELECT * FROM loopscope.make_partitions('2020-02-15', 1)").size(), 4u);
  EXPECT_EQ(where("2020-02-01 00:00:00+00"), "loopscope.verdict_2020_02");
  EXPECT_EQ(where("2020-02-29 23:59:59.999999+00"), "loopscope.verdict_2020_02");
  EXPECT_EQ(where("2020-03-01 00:00:00+00"), "loopscope.verdict_default");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.verdict"), "3");
}

TEST_F(PartitionTest, MonthsAreUtcWhereverTheServerStands) {
  database->execute("ALTER DATABASE " + database->name() + " SET timezone = 'Asia/Kathmandu';");
  database->execute("SELECT loopscope.make_partitions('2020-02-15', 1)");
  add_loops({"a"});
  store("a", "2020-01-31 23:59:59+00");
  store("a", "2020-02-01 00:00:00+00");
  EXPECT_EQ(where("2020-01-31 23:59:59+00"), "loopscope.verdict_default");
  EXPECT_EQ(where("2020-02-01 00:00:00+00"), "loopscope.verdict_2020_02");
}

TEST_F(PartitionTest, OldMonthsAreDroppedAndStrayRowsDeleted) {
  add_loops({"a"});
  database->execute("SELECT loopscope.make_partitions('2020-02-15', 1)");
  store("a", "2020-02-02 00:00:00+00");
  store("a", "2019-01-01 00:00:00+00");
  database->execute(
      "INSERT INTO loopscope.plant_oscillation (slot_end, algorithm_revision, number, period_s,"
      " loop_ids, strengths, lags_s, statement)"
      " VALUES ('2019-01-01', 1, 1, 40, '{1,2}', '{1,1}', '{0,0}', '')");
  EXPECT_THAT(maintain(settings_for(*database), {}).dropped, IsEmpty()) << "0 keeps all";
  store_analysis("now() - interval '1 hour'");
  const MaintenanceResult result = maintain(settings_for(*database), {.retention_months = 24});
  EXPECT_EQ(result.dropped,
            (std::vector<std::string>{"bicoherence_peak_2020_02", "explanation_step_2020_02",
                                      "verdict_2020_02", "analysis_2020_02"}));
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.verdict"), "0");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.plant_oscillation"), "0");
  EXPECT_EQ(value("SELECT count(*) FROM pg_inherits"
                  " WHERE inhparent = 'loopscope.analysis'::regclass"),
            "5");
}

TEST_F(PartitionTest, AClockThatRanOnWithoutResultsExpiresNothing) {
  add_loops({"a"});
  database->execute("SELECT loopscope.make_partitions('2020-02-15', 2)");
  store_analysis("'2020-03-02'");
  store("a", "2020-02-02 00:00:00+00");
  store("a", "2020-03-02 00:00:00+00");
  EXPECT_THAT(maintain(settings_for(*database), {.retention_months = 1}).dropped, IsEmpty());
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.verdict"), "2");
}

TEST_F(PartitionTest, ManyMonthsAtOnceNeedAPersonsWord) {
  add_loops({"a"});
  database->execute("SELECT loopscope.make_partitions('2020-02-15', 3)");
  store_analysis("now() - interval '1 hour'");
  store("a", "2019-02-02 00:00:00+00");
  try {
    maintain(settings_for(*database), {.retention_months = 24});
    ADD_FAILURE() << "dropped three months";
  } catch (const DatabaseError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("3 months of results would be dropped at once, 2020_02 to"));
    EXPECT_THAT(error.hint(), HasSubstr("--accept-clock"));
  }
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.verdict"), "1");
  const MaintenanceOrders orders{.retention_months = 24, .check = {}, .drop_many = true};
  EXPECT_EQ(maintain(settings_for(*database), orders).dropped.size(), 12U);
}

TEST_F(PartitionTest, NothingIsMadeOrDroppedUnderAClockThatIsNotBelieved) {
  database->execute("DROP TABLE loopscope.analysis_" +
                    value("SELECT to_char(now() AT TIME ZONE 'UTC', 'YYYY_MM')"));
  MaintenanceOrders orders{.retention_months = 24, .check = {}, .drop_many = true};
  orders.check = [](const ServerClock&) {
    throw DatabaseError("the clock is wrong", "set it", Remedy::retry);
  };
  const std::string before = value("SELECT count(*) FROM pg_inherits");
  EXPECT_THROW(maintain(settings_for(*database), orders), DatabaseError);
  EXPECT_EQ(value("SELECT count(*) FROM pg_inherits"), before);
}

/// Where all results are kept, what is none is not.
TEST_F(PartitionTest, LostWorkersAndOldCostsGoWhateverIsKept) {
  add_loops({"a"});
  store("a", "2019-01-01 00:00:00+00");
  database->execute(
      "INSERT INTO loopscope.worker (worker, program_version, algorithm_revision, last_seen,"
      " held_loops, lost_leases) VALUES ('gone/1', '1', 1, now() - interval '40 days', 0, 0),"
      " ('here/1', '1', 1, now(), 0, 0);"
      "INSERT INTO loopscope.stage_cost SELECT now() - age, 'gone', 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,"
      " 1, 1, 1 FROM (VALUES (interval '3 years'), (interval '1 year')) AS old (age)");
  maintain(settings_for(*database), {});
  EXPECT_EQ(value("SELECT string_agg(worker, ',') FROM loopscope.worker"), "here/1");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.stage_cost"), "1");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.verdict"), "1");
}

TEST_F(PartitionTest, WorkersWriteWhileAMonthIsMade) {
  add_loops({"a"});
  ResultsDatabase results = connect();
  const ClaimedLoop claim = claim_all(results).at(0);
  database->execute("BEGIN; SELECT loopscope.make_partitions('2020-02-15', 1); COMMIT");
  EXPECT_EQ(results.finish(std::vector{completed(claim, 1'581'000'000'000'000, "d")}, {}).inserted,
            1u);
  EXPECT_EQ(where("2020-02-06 14:40:00+00"), "loopscope.verdict_2020_02");
}

}  // namespace
}  // namespace loopscope::storage
