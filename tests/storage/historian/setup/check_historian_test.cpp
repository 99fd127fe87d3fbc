#include "storage/historian/setup/check_historian.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <sstream>

#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

class CheckHistorianTest : public HistorianTest {
 protected:
  std::vector<Finding> check() { return check_historian(settings(), layout); }

  /// As somebody would who has psql: a statement after the other.
  void follow_hint() {
    for (const Finding& found : check()) {
      std::istringstream statements(found.index_sql);
      for (std::string statement; std::getline(statements, statement, ';');)
        database->execute(statement);
    }
  }
};

auto finding(bool ok, bool warning, const std::string& words) {
  return AllOf(Field(&Finding::ok, ok), Field(&Finding::warning, warning),
               Field(&Finding::what, HasSubstr(words)));
}

TEST_F(CheckHistorianTest, GoodTableWithFreshRowsIsAllRight) {
  database->execute("INSERT INTO history VALUES ('a', now() - interval '1 minute', 1, 192)");
  std::vector<std::string> said;
  for (const Finding& found : check()) {
    EXPECT_TRUE(found.ok && !found.warning) << found.what;
    EXPECT_EQ(found.hint, "");
    said.push_back(found.what);
  }
  const std::string table = R"("public"."history")";
  EXPECT_THAT(
      said,
      ElementsAre(
          StartsWith("connected to the historian database ("),
          table + " has the columns and can be read",
          "an index serves the reading of windows, " + table,
          "the plan of a window uses indexes only, " + table,
          MatchesRegex("the window of a tag was read, rows: 1 in [0-9]+ ms, " + table),
          MatchesRegex("the newest row is of [-0-9]+ [0-9:]+ UTC, 60(.[0-9])? s ago, " + table)));
}

TEST_F(CheckHistorianTest, OldOrFutureRowsAreWarnedOf) {
  EXPECT_THAT(
      check(),
      Contains(AllOf(finding(true, true,
                             "no row is younger than a week, "
                             R"("public"."history")"),
                     Field(&Finding::hint, "check that the historian records, and `time_kind`"))));
  database->execute("INSERT INTO history VALUES ('a', now() + interval '1 hour', 1, 192)");
  EXPECT_THAT(check(), Contains(AllOf(finding(true, true, "the newest row lies in the future, at "),
                                      Field(&Finding::hint,
                                            "check `time_kind`, the time zone of the "
                                            "recorder and its clock"))));
}

TEST_F(CheckHistorianTest, RowsThatStoppedComingAreWarnedOfWhereTheyCameOften) {
  const auto warned =
      finding(true, true, "rows of a tag come every 5 s, and the newest row is of ");
  database->execute(
      "INSERT INTO history SELECT 'a', now() - interval '1 hour' - k * interval '5 s', 1, 192"
      " FROM generate_series(0, 2000) AS k");
  EXPECT_THAT(check(),
              Contains(AllOf(warned, Field(&Finding::what, HasSubstr(" UTC, 60 min ago, ")),
                             Field(&Finding::hint, HasSubstr("--time-zone")))));
  // An outage of half an hour: an hour may be the next one.
  database->execute(
      "DELETE FROM history WHERE time BETWEEN now() - interval '2.5 h' AND now() - interval '2 h'");
  EXPECT_THAT(check(), Not(Contains(warned)));
  // Every second while a setpoint was moved, nothing for long before and since: stored on change.
  database->execute(
      "DELETE FROM history WHERE time < now() - interval '80 min';"
      "INSERT INTO history VALUES ('a', now() - interval '3 h', 1, 192)");
  EXPECT_THAT(check(), Contains(finding(true, false, ", 60 min ago, ")));
}

TEST_F(CheckHistorianTest, IndexIsJudged) {
  database->execute("DROP INDEX history_tag_time_value_quality_idx");
  const std::vector<Finding> found = check();
  EXPECT_THAT(found, Contains(finding(true, true,
                                      "no index starts with (tag, time), so every window scans "
                                      R"(the table, which is slow, "public"."history")")));
  const std::string sql = R"(CREATE INDEX CONCURRENTLY ON "public"."history" ("tag", "time") )"
                          R"(INCLUDE ("value", "quality");)";
  const std::string owner = database->value("SELECT current_user");
  EXPECT_THAT(found,
              Contains(AllOf(Field(&Finding::index_sql, sql), Field(&Finding::table_owner, owner),
                             Field(&Finding::hint, "as the owner of the table, " + owner +
                                                       ", on the historian: " + sql))));
  database->execute("CREATE INDEX ON history (time, tag); CREATE INDEX ON history (tag)");
  EXPECT_THAT(check(), Contains(finding(true, true, "no index starts with (tag, time)")));
  database->execute("CREATE INDEX ON history (tag, time DESC)");
  EXPECT_THAT(check(),
              Contains(finding(true, true,
                               "the index on (tag, time) does not include the value: "
                               "where the rows of a tag lie far apart, reading is up to "
                               R"(three times slower than it could be, "public"."history")")));
}

TEST_F(CheckHistorianTest, HintIsSqlThatWorks) {
  database->execute("DROP INDEX history_tag_time_value_quality_idx");
  follow_hint();
  EXPECT_THAT(check(), Contains(finding(true, false, "an index serves")));
}

TEST_F(CheckHistorianTest, HintIsSqlThatAPartitionedTableTakes) {
  database->execute(
      "DROP TABLE history; CREATE SCHEMA old; CREATE TABLE history (tag text NOT NULL, time"
      " timestamptz NOT NULL, value float8, quality smallint) PARTITION BY RANGE (time);"
      R"(CREATE TABLE "of a ""year" PARTITION OF history DEFAULT;)"
      "CREATE TABLE old.past PARTITION OF history FOR VALUES FROM ('2020-01-01') TO "
      "('2025-01-01')");
  follow_hint();
  EXPECT_EQ(database->value("SELECT count(*) FROM pg_index WHERE NOT indisvalid"), "0");
  EXPECT_THAT(check(), Contains(finding(true, false, "an index serves")));
}

TEST_F(CheckHistorianTest, HintForManyPartitionsIsOneStatement) {
  database->execute(
      "DROP TABLE history; CREATE TABLE history (tag text NOT NULL, time timestamptz NOT NULL,"
      " value float8, quality smallint) PARTITION BY HASH (tag)");
  for (int part = 0; part < 7; ++part) {
    database->execute("CREATE TABLE history_" + std::to_string(part) +
                      " PARTITION OF history FOR VALUES WITH (MODULUS 7, REMAINDER " +
                      std::to_string(part) + ")");
  }
  EXPECT_THAT(check(), Contains(Field(&Finding::hint, HasSubstr("ATTACH PARTITION"))));
  follow_hint();
  EXPECT_THAT(check(), Contains(finding(true, false, "an index serves")));
}

// TimescaleDB itself is not there: its chunks are.
TEST_F(CheckHistorianTest, HypertableGetsItsIndexChunkByChunk) {
  database->execute(
      "DROP INDEX history_tag_time_value_quality_idx; CREATE SCHEMA _timescaledb_internal;"
      "CREATE TABLE _timescaledb_internal._hyper_1_1_chunk () INHERITS (history)");
  EXPECT_THAT(check(), Contains(Field(&Finding::index_sql,
                                      R"(CREATE INDEX ON "public"."history" ("tag", "time") )"
                                      R"(INCLUDE ("value", "quality") )"
                                      "WITH (timescaledb.transaction_per_chunk);")));
}

TEST_F(CheckHistorianTest, MissingGrantsAreNamedAtOnceWithTheirSchemas) {
  database->execute(
      "CREATE SCHEMA site; CREATE TABLE site.names (id bigint, name text);"
      "CREATE TABLE site.rows (tag bigint, time timestamptz, value float8, quality int);"
      "CREATE INDEX ON site.rows (tag, time) INCLUDE (value, quality)");
  layout.relation = "site.rows";
  layout.key.front().names = SideTable{"site.names", "name", "id"};
  const std::string reader = database->make_login("");
  const auto check = [&] { return check_historian(settings(reader), layout); };
  const std::vector<Finding> found = check();
  EXPECT_THAT(found,
              Contains(AllOf(finding(false, false, "has no right to read site.rows"),
                             Field(&Finding::hint,
                                   R"(as the owner: GRANT USAGE ON SCHEMA "site" TO ")" + reader +
                                       R"("; GRANT SELECT ON "site"."rows", "site"."names" TO ")" +
                                       reader + "\""))));
  const std::string as_owner = "as the owner: ";
  database->execute(found.back().hint.substr(as_owner.size()));
  EXPECT_TRUE(std::ranges::all_of(check(), &Finding::ok));
}

TEST_F(CheckHistorianTest, TheStatementOfAWindowIsRunNotOnlyPlanned) {
  database->execute(
      "INSERT INTO history VALUES ('a', now(), 0, 192);"
      "CREATE VIEW broken AS SELECT tag, time, 1 / value AS value, quality FROM history");
  layout.relation = "public.broken";
  EXPECT_THAT(check(),
              Contains(finding(false, false,
                               "the window of a tag cannot be read: division by zero, statement "
                               "read_scans")));
}

TEST_F(CheckHistorianTest, ProblemsAreFindingsNotExceptions) {
  layout.relation = "public.nothing";
  EXPECT_THAT(check(), Contains(finding(false, false, "no such table")));
  ConnectionSettings nowhere = settings();
  nowhere.conninfo = "host=/no/such/folder";
  EXPECT_THAT(check_historian(nowhere, layout), Contains(finding(false, false, "/no/such")));
  nowhere.conninfo = "nonsense";
  EXPECT_THAT(check_historian(nowhere, layout), Contains(finding(false, false, "cannot be read")));
}

TEST_F(CheckHistorianTest, ViewIsReadButItsIndexCannotBeSeen) {
  database->execute("CREATE VIEW seen AS SELECT * FROM history");
  layout.relation = "public.seen";
  EXPECT_THAT(check(), Contains(AllOf(finding(true, true,
                                              R"("public"."seen" is a view or a foreign table: )"
                                              "its indexes were not checked"),
                                      Field(&Finding::hint,
                                            "make sure that the table behind it has an index "
                                            "on (tag, time)"))));
}

}  // namespace
}  // namespace loopscope::storage
