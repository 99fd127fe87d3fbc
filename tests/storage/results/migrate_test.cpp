#include "storage/results/migrate.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <sstream>
#include <thread>

#include "storage/results/embedded_migrations.hpp"
#include "tests/storage/results/results_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// An empty database.
class MigrateTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
    database = std::make_unique<tests::TestDatabase>();
    database->make_roles();
  }
  [[nodiscard]] std::string error_of_connecting() const {
    try {
      const ResultsDatabase results(settings_for(*database));
      return "";
    } catch (const DatabaseError& error) {
      EXPECT_EQ(error.remedy(), Remedy::give_up);
      return std::string(error.what()) + " HINT: " + error.hint();
    }
  }
  std::unique_ptr<tests::TestDatabase> database;
};

TEST(EmbeddedMigrations, AreTheFilesAsTheyStand) {
  for (const Migration& migration : embedded_migrations()) {
    const std::ifstream file(tests::source_dir() / "storage" / "migrations" /
                             (std::string(migration.name) + ".sql"));
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_EQ(migration.sql, text.str()) << migration.name;
  }
  EXPECT_EQ(static_cast<int>(embedded_migrations().size()), required_schema_version());
}

TEST_F(MigrateTest, AppliesAllOnceAndThenNothing) {
  EXPECT_THAT(error_of_connecting(), HasSubstr("does not exist HINT: run `loopscope migrate"));
  EXPECT_EQ(static_cast<int>(migrate(settings_for(*database)).size()), required_schema_version());
  EXPECT_EQ(error_of_connecting(), "");
  EXPECT_THAT(migrate(settings_for(*database)), IsEmpty());
  EXPECT_EQ(database->value("SELECT count(*) FROM loopscope.schema_migration"),
            std::to_string(required_schema_version()));
}

TEST_F(MigrateTest, SideBySideOneDoesTheWork) {
  std::vector<std::size_t> applied(3);
  {
    std::vector<std::jthread> runs;
    for (std::size_t& count : applied) {
      runs.emplace_back([&count, this] { count = migrate(settings_for(*database)).size(); });
    }
  }
  EXPECT_EQ(applied[0] + applied[1] + applied[2],
            static_cast<std::size_t>(required_schema_version()));
}

TEST_F(MigrateTest, EverythingHasAComment) {
  migrate(settings_for(*database));
  EXPECT_THAT(database->rows("SELECT c.relname FROM pg_class AS c"
                             " WHERE c.relnamespace = 'loopscope'::regnamespace"
                             " AND c.relkind IN ('r', 'p', 'v', 'S')"
                             " AND c.relname NOT LIKE '%\\_seq'"
                             " AND obj_description(c.oid, 'pg_class') IS NULL"),
              IsEmpty());
  EXPECT_THAT(database->rows("SELECT c.relname, a.attname FROM pg_class AS c"
                             " JOIN pg_attribute AS a ON a.attrelid = c.oid AND a.attnum > 0"
                             " WHERE c.relnamespace = 'loopscope'::regnamespace"
                             " AND c.relkind IN ('r', 'p', 'v') AND NOT a.attisdropped"
                             " AND col_description(c.oid, a.attnum) IS NULL"),
              IsEmpty());
  EXPECT_THAT(database->rows("SELECT p.proname FROM pg_proc AS p"
                             " WHERE p.pronamespace = 'loopscope'::regnamespace"
                             " AND obj_description(p.oid, 'pg_proc') IS NULL"),
              IsEmpty());
}

/// Makes the schema one of a later program, which served the programs from `oldest` on.
void migrate_further(const tests::TestDatabase& database, int oldest) {
  database.execute("INSERT INTO loopscope.schema_migration VALUES (9999, '9999_future', 'x')");
  database.execute(
      "CREATE OR REPLACE FUNCTION loopscope.oldest_program() RETURNS integer IMMUTABLE"
      " LANGUAGE sql RETURN " +
      std::to_string(oldest));
}

TEST_F(MigrateTest, NewerSchemaThatWasOnlyAddedToServes) {
  migrate(settings_for(*database));
  migrate_further(*database, required_schema_version());
  EXPECT_EQ(error_of_connecting(), "");
  EXPECT_THROW(migrate(settings_for(*database)), DatabaseError);
}

/// A program that was put back goes on with the schema's own functions, whatever they have become.
TEST_F(MigrateTest, NewerSchemaThatWasOnlyAddedToIsMaintained) {
  migrate(settings_for(*database));
  database->execute("SELECT loopscope.make_partitions('2020-02-15', 1)");
  const std::string newest =
      "'loopscope.verdict' || to_char(now() AT TIME ZONE 'UTC' + interval '1 month', '_YYYY_MM')";
  database->execute("DO $$ BEGIN EXECUTE 'DROP TABLE ' || " + newest + "; END $$");
  migrate_further(*database, required_schema_version());
  const MaintenanceResult result = maintain(settings_for(*database), {.retention_months = 24});
  EXPECT_EQ(result.created.size(), 1u);
  EXPECT_EQ(result.dropped.size(), 4u);
  EXPECT_EQ(database->value("SELECT to_regclass(" + newest + ") IS NOT NULL"), "t");
}

TEST_F(MigrateTest, NewerSchemaIsRefused) {
  migrate(settings_for(*database));
  migrate_further(*database, required_schema_version() + 1);
  EXPECT_THAT(error_of_connecting(), HasSubstr("newer than this program's"));
  EXPECT_THROW(migrate(settings_for(*database)), DatabaseError);
  EXPECT_THROW(maintain(settings_for(*database), {}), DatabaseError);
}

TEST_F(MigrateTest, OlderSchemaIsRefusedByTheWorker) {
  migrate(settings_for(*database));
  database->execute(
      "DELETE FROM loopscope.schema_migration WHERE version = (SELECT max(version)"
      " FROM loopscope.schema_migration)");
  EXPECT_THAT(error_of_connecting(), HasSubstr("run `loopscope migrate --config F` as the owner"));
}

TEST_F(MigrateTest, ChangedHistoryIsRefused) {
  migrate(settings_for(*database));
  database->execute("UPDATE loopscope.schema_migration SET sha256 = 'other' WHERE version = 2");
  try {
    migrate(settings_for(*database));
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("applied with another text"));
  }
}

TEST_F(MigrateTest, FailureLeavesNothingBehind) {
  database->execute(
      "SET ROLE loopscope_owner; CREATE SCHEMA loopscope;"
      " CREATE TABLE loopscope.verdict (in_the_way int)");
  EXPECT_THROW(migrate(settings_for(*database)), DatabaseError);
  EXPECT_EQ(database->value("SELECT count(*) FROM pg_class WHERE relnamespace ="
                            " 'loopscope'::regnamespace"),
            "1");
}

TEST_F(MigrateTest, VerdictKindsAreTheProgramsVerdicts) {
  migrate(settings_for(*database));
  for (const core::diagnosis::VerdictCode code : core::diagnosis::all_verdict_codes()) {
    const std::string word(core::diagnosis::name(code));
    const bool is_fault = word != "healthy" && word != "insufficient_data";
    EXPECT_EQ(database->value("SELECT is_fault AND weight > 0 OR NOT is_fault AND weight IS NULL"
                              " FROM loopscope.verdict_kind WHERE code = '" +
                              word + "'"),
              "t");
    EXPECT_EQ(
        database->value("SELECT is_fault FROM loopscope.verdict_kind WHERE code = '" + word + "'"),
        is_fault ? "t" : "f");
    EXPECT_EQ(database->value("SELECT pg_get_constraintdef(oid) LIKE '%''" + word +
                              "''%'"
                              " FROM pg_constraint WHERE conname = 'verdict_code_check'"
                              " AND conrelid = 'loopscope.verdict'::regclass"),
              "t");
  }
  EXPECT_EQ(database->value("SELECT count(*) FROM loopscope.verdict_kind"),
            std::to_string(core::diagnosis::all_verdict_codes().size()));
}

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
