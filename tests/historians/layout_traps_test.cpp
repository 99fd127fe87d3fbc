#include <gmock/gmock.h>

#include "storage/historian/setup/check_historian.hpp"
#include "tests/historians/trap.hpp"

namespace loopscope::tests {
namespace {

using core::signal::RawSeries;
using storage::RowBefore;
using storage::TagRequest;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

TEST_F(Trap, LocalTimesNeedTheirZoneAndTheRepeatedHourIsBad) {
  use("narrow",
      "CREATE TABLE local (tag text, time timestamp, value float8);"
      // 25 October 2026: 02:30 comes twice in Berlin.
      "INSERT INTO local VALUES ('a', '2026-10-25 01:30', 1), ('a', '2026-10-25 02:30', 2),"
      " ('a', '2026-10-25 03:30', 3), ('a', '2026-03-29 03:30', 4)");
  settings.table = "local";
  settings.time_kind = "timestamp_local";
  settings.time_zone = "Europe/Berlin";
  settings.quality_column = "";
  settings.quality_rule = "none";
  storage::HistorianReader historian = reader();
  constexpr std::int64_t kHour = 3'600'000'000;
  constexpr std::int64_t kDay = 1'792'886'400'000'000;  // 2026-10-25 00:00 UTC
  const RawSeries rows =
      historian
          .read(std::vector{TagRequest{"a", kDay - kHour, kDay + 3 * kHour, 99, RowBefore::no}})
          .at(0);
  EXPECT_THAT(rows.value, ElementsAre(1.0, IsNan(), 3.0));
  EXPECT_EQ(rows.time_us[0], kDay - kHour / 2) << "summer time: two hours before UTC";
  EXPECT_EQ(rows.time_us[2], kDay + 5 * kHour / 2);
  settings.time_zone = "Europe/Nowhere";
  try {
    reader();
    ADD_FAILURE() << "accepted";
  } catch (const storage::DatabaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no such time zone: \"Europe/Nowhere\""));
    EXPECT_THAT(error.hint(), HasSubstr("pg_timezone_names"));
  }
}

TEST_F(Trap, RowsOfOtherFieldsDoNotTakeTheTagsPlaces) {
  use("telegraf",
      "ALTER TABLE control ADD COLUMN a float8; INSERT INTO control (time, loop, a)"
      " SELECT time + interval '1 ms', loop, 1 FROM control, generate_series(1, 5)");
  storage::HistorianReader historian = reader();
  const std::vector<TagRequest> wanted{{"FIC1.pv", Truth::time_us(0), Truth::time_us(kRows - 1),
                                        std::int64_t{2} * kRows, RowBefore::no}};
  EXPECT_EQ(historian.read(wanted).at(0).value.size(), static_cast<std::size_t>(kRows));
}

TEST_F(Trap, ANameInBracketsIsANameAndOneBadRowOfNamesHurtsNobody) {
  use("timescale_narrow",
      "ALTER TABLE tags DROP CONSTRAINT tags_pkey; ALTER TABLE tags ALTER tag_id TYPE text;"
      "ALTER TABLE tags ALTER tag_id DROP NOT NULL;"
      "INSERT INTO tags VALUES ('13', '[PLC1]FIC1.pv'), (NULL, 'FIC7.pv'), ('n/a', 'FIC8.pv')");
  storage::HistorianReader historian = reader();
  const auto wanted = [](const char* tag) {
    return TagRequest{tag, Truth::time_us(0), Truth::time_us(0), 9, RowBefore::no};
  };
  const auto rows = historian.read(std::vector{wanted("[PLC1]FIC1.pv"), wanted("FIC1.pv"),
                                               wanted("FIC7.pv"), wanted("FIC8.pv")});
  EXPECT_THAT(rows[0].value, ElementsAre(value("op", 0))) << "13 is the id of op";
  EXPECT_THAT(rows[1].value, ElementsAre(value("pv", 0)));
  EXPECT_TRUE(rows[2].empty() && rows[3].empty());
}

TEST_F(Trap, EpicsWithoutNanosecondsIsAtTheFullSecond) {
  use("epics",
      "ALTER TABLE sample ALTER nanosecs DROP NOT NULL;"
      "UPDATE sample SET nanosecs = NULL WHERE smpl_time >= '2026-02-27 00:03:00+00'");
  storage::HistorianReader historian = reader();
  EXPECT_EQ(read(historian, "pv").value.size(), 20U);
  EXPECT_EQ(historian.newest(std::vector{tag_of(*chosen, 1, "pv")}, Truth::time_us(kRows))[0],
            Truth::time_us(kRows - 1) - 125'000);
}

TEST_F(Trap, OfTwoRowsBeforeTheWindowTheSameOneCountsEveryTime) {
  use("narrow");
  for (const char* order : {"(10), (99), (NULL)", "(NULL), (99), (10)"}) {
    database->execute(std::string("DELETE FROM history WHERE tag = 'twice'; INSERT INTO history"
                                  " SELECT 'twice', '2026-02-26', v, 192 FROM (VALUES ") +
                      order + ") AS t (v)");
    storage::HistorianReader historian = reader();
    const std::vector<TagRequest> wanted{
        {"twice", Truth::time_us(0), Truth::time_us(1), 9, RowBefore::yes}};
    EXPECT_THAT(historian.read(wanted).at(0).value, ElementsAre(99.0)) << order;
  }
}

TEST_F(Trap, AColumnThatDoesNotExistOrIsEmptyHasNoNewestRow) {
  use("wide", "ALTER TABLE wide_history ADD COLUMN dead float8");
  storage::HistorianReader historian = reader();
  const std::vector<std::string> tags{"FIC1.pv", "nowhere", "dead"};
  EXPECT_THAT(historian.newest(tags, Truth::time_us(kRows)),
              ElementsAre(Truth::time_us(kRows - 1), std::nullopt, std::nullopt));
}

TEST_F(Trap, AnIndexThatCannotServeIsNone) {
  use("narrow",
      "DROP INDEX history_tag_time_value_quality_idx; CREATE INDEX ON history USING brin (tag, "
      "time);"
      "CREATE INDEX ON history (lower(tag), tag, time)");
  bool missing = false;
  for (const storage::Finding& finding : storage::check_historian(
           daemon::historian_connection(settings), daemon::historian_layout(settings))) {
    missing = missing || (finding.warning && finding.index_sql.starts_with("CREATE INDEX"));
  }
  EXPECT_TRUE(missing);
}

TEST_F(Trap, HostileNamesAreNamesAndNothingElse) {
  use("wide",
      R"(ALTER TABLE wide_history ADD COLUMN "x"" FROM truth; DROP TABLE truth; --" float8;)"
      R"(UPDATE wide_history SET "x"" FROM truth; DROP TABLE truth; --" = 3)");
  storage::HistorianReader historian = reader();
  const std::vector<TagRequest> wanted{
      {R"(x" FROM truth; DROP TABLE truth; --)", Truth::time_us(0), Truth::time_us(1), 9,
       RowBefore::no},
      {"time", Truth::time_us(0), Truth::time_us(1), 9, RowBefore::no},
      {std::string("\0\xff", 2), Truth::time_us(0), Truth::time_us(1), 9, RowBefore::no}};
  const auto rows = historian.read(wanted);
  EXPECT_THAT(rows[0].value, ElementsAre(3.0, 3.0));
  EXPECT_TRUE(rows[1].empty() && rows[2].empty());
  EXPECT_EQ(database->value("SELECT count(*) FROM truth"), "20");
}

}  // namespace
}  // namespace loopscope::tests
