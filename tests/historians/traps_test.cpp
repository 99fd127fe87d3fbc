#include <gmock/gmock.h>

#include "core/signal/grid.hpp"
#include "daemon/service/storage_settings.hpp"
#include "storage/historian/check_historian.hpp"
#include "storage/historian/historian_reader.hpp"
#include "tests/historians/truth.hpp"
#include "tests/historians/vendor.hpp"

namespace loopscope::tests {
namespace {

using core::signal::Hold;
using core::signal::RawSeries;
using storage::RowBefore;
using storage::TagRequest;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

constexpr int kRows = 20;

/// One vendor's tables with 20 rows of one loop, spoilt as each test says.
class Trap : public testing::Test {
 protected:
  void SetUp() override {
    if (!test_server()) GTEST_SKIP() << kNoServer;
    database.emplace();
    truth.emplace(*database, 1, kRows);
  }

  void use(const std::string& name, const std::string& spoil = "") {
    chosen = &vendor(name);
    database->execute(chosen->tables);
    if (!spoil.empty()) database->execute(spoil);
    settings = settings_of(*chosen, database->conninfo());
  }

  storage::HistorianReader reader() const {
    return {daemon::historian_connection(settings), daemon::historian_layout(settings)};
  }

  RawSeries read(storage::HistorianReader& historian, const std::string& role, int first = 0,
                 int last = kRows - 1, RowBefore before = RowBefore::no) const {
    return historian
        .read(std::vector{TagRequest{tag_of(*chosen, 1, role), Truth::time_us(first),
                                     Truth::time_us(last), 1000, before}})
        .at(0);
  }
  RawSeries read(const std::string& role) const {
    storage::HistorianReader historian = reader();
    return read(historian, role);
  }
  double value(const std::string& role, int k) const { return truth->rows(1, role, k, k)[0].value; }

  std::optional<TestDatabase> database;
  std::optional<Truth> truth;
  const Vendor* chosen = nullptr;
  config::HistorianSettings settings;
};

TEST_F(Trap, IgnitionOnly192IsGoodAndTheQueryModeTellsTheInterpolation) {
  use("ignition",
      "UPDATE sqlt_data_1_2026_02 SET dataintegrity = 193 WHERE t_stamp = 1772150410125;"
      "UPDATE sqlth_te SET querymode = 0 WHERE tagpath LIKE '%/sp'");
  const RawSeries pv = read("pv");
  EXPECT_THAT(pv.value[1], IsNan());
  EXPECT_EQ(pv.value[2], value("pv", 2));
  EXPECT_EQ(pv.hold, Hold::linear);
  EXPECT_EQ(read("sp").hold, Hold::step);
}

TEST_F(Trap, IgnitionTablesComeAndGoWhileTheReaderLives) {
  use("ignition");
  storage::HistorianReader historian = reader();
  database->execute(
      "CREATE TABLE sqlt_data_3_2026_04 (LIKE sqlt_data_1_2026_02 INCLUDING ALL);"
      "INSERT INTO sqlt_data_3_2026_04 SELECT * FROM sqlt_data_1_2026_02 WHERE t_stamp >="
      " 1772150450125; DELETE FROM sqlt_data_1_2026_02 WHERE t_stamp >= 1772150450125;"
      "INSERT INTO sqlth_partitions (pname, drvid, start_time, end_time) VALUES"
      " ('sqlt_data_3_2026_04', 3, 1772150450000, 0)");
  EXPECT_EQ(read(historian, "pv").value.size(), 20U) << "a table without an end is being written";
  database->execute("DELETE FROM sqlth_partitions; DROP TABLE sqlt_data_2_2026_03");
  EXPECT_TRUE(read(historian, "pv").empty());
}

TEST_F(Trap, IgnitionIdsOfOnePathAreReadTogetherAndTheLaterOneWins) {
  use("ignition",
      "INSERT INTO sqlt_data_1_2026_02 SELECT id, NULL, 7, NULL, NULL, 192, 1772150410125"
      " FROM sqlth_te WHERE tagpath LIKE '%/pv' AND scid = 2");
  const RawSeries pv = read("pv");
  ASSERT_EQ(pv.value.size(), 21U);
  EXPECT_EQ(core::signal::count_repeated_times(pv), 1U);
  EXPECT_EQ(pv.value[2], 7.0) << "of two rows with one time the last one counts";
}

TEST_F(Trap, ThingsboardDevicesGoByUuidTooAndValuesByWhicheverColumnHasThem) {
  use("thingsboard",
      "UPDATE ts_kv SET dbl_v = NULL, long_v = NULL, bool_v = true WHERE ts = 1772150410125;"
      "UPDATE ts_kv SET dbl_v = NULL, long_v = NULL, str_v = ' 1.5e1 ' WHERE ts = 1772150420125;"
      "ALTER TABLE ts_kv_dictionary RENAME TO key_dictionary");
  settings.subtag_table = "public.key_dictionary";
  storage::HistorianReader historian = reader();
  const RawSeries rows =
      historian
          .read(std::vector{TagRequest{"00000000-0000-0000-0000-000000000001/pv", Truth::time_us(0),
                                       Truth::time_us(3), 99, RowBefore::no}})
          .at(0);
  EXPECT_THAT(rows.value, ElementsAre(value("pv", 0), 1.0, 15.0, value("pv", 3)));
}

TEST_F(Trap, TelegrafSendsTwiceAddsColumnsAndHasNoIndex) {
  use("telegraf", "INSERT INTO control SELECT * FROM control");
  storage::HistorianReader historian = reader();
  const RawSeries pv = read(historian, "pv");
  EXPECT_EQ(pv.value.size(), 40U);
  EXPECT_EQ(core::signal::count_repeated_times(pv), 20U);
  EXPECT_TRUE(read(historian, "mode").empty());
  database->execute("ALTER TABLE control ADD COLUMN mode text; UPDATE control SET mode = 'AUTO'");
  const std::vector<TagRequest> mode{
      {"FIC1.mode", Truth::time_us(0), Truth::time_us(0), 99, RowBefore::no}};
  EXPECT_THAT(historian.read(mode).at(0).value, testing::Each(1.0));
  database->execute("DROP INDEX control_loop_time_idx");
  bool missing = false;
  for (const storage::Finding& finding : storage::check_historian(
           daemon::historian_connection(settings), daemon::historian_layout(settings))) {
    missing = missing || (!finding.ok && finding.hint.starts_with("CREATE INDEX CONCURRENTLY ON"
                                                                  " \"public\".\"control\""));
  }
  EXPECT_TRUE(missing);
}

TEST_F(Trap, OfTwoValuesAtOneTimeTheSameOneCountsEveryTime) {
  use("telegraf",
      "INSERT INTO control (time, loop, pv) VALUES"
      " ('2026-02-27 00:00:10.125', 'FIC1', 900), ('2026-02-27 00:00:10.125', 'FIC1', 5)");
  const RawSeries pv = read("pv");
  ASSERT_EQ(pv.value.size(), 22U);
  EXPECT_EQ(pv.value[3], 900.0) << "no column tells them apart: the largest comes last";
}

TEST_F(Trap, HomeAssistantHasTextsForNoValue) {
  use("home_assistant",
      "UPDATE states SET state = 'unavailable' WHERE state_id % 4 = 0;"
      "INSERT INTO states (metadata_id, state, last_updated_ts) VALUES (12, '1e999', 1772150411),"
      " (12, 'on', 1772150412), (12, ' OFF ', 1772150413), (12, '', 1772150414)");
  const RawSeries pv = read("pv");
  EXPECT_EQ(pv.hold, Hold::step);
  ASSERT_EQ(pv.value.size(), 24U);
  EXPECT_THAT(pv.value[2], IsNan());
  EXPECT_THAT(std::vector(pv.value.begin() + 3, pv.value.begin() + 5), ElementsAre(1.0, 0.0));
  EXPECT_THAT(pv.value[5], IsNan());
  EXPECT_EQ(std::count_if(pv.value.begin(), pv.value.end(), [](double v) { return v != v; }), 7);
}

TEST_F(Trap, RapidScadaAlarmStatesAreGoodAndUnknownCodesAreCounted) {
  use("rapid_scada",
      "UPDATE mod_arc_postgre_sql.min_historical SET stat = 0 WHERE time_stamp ="
      " '2026-02-27 00:00:10.125+00';"
      "UPDATE mod_arc_postgre_sql.min_historical SET stat = 99 WHERE time_stamp >="
      " '2026-02-27 00:03:00+00'");
  const RawSeries pv = read("pv");
  EXPECT_EQ(pv.value[0], value("pv", 0));
  EXPECT_THAT(pv.value[1], IsNan());
  EXPECT_THAT(pv.value[18], IsNan());
  EXPECT_EQ(pv.unknown_quality, 2U);
}

TEST_F(Trap, ScadaLtsTellsRowsOfOneTimeApartByTheirId) {
  use("scada_lts",
      "INSERT INTO pointvalues (datapointid, datatype, pointvalue, ts) VALUES"
      " (12, 3, 900, 1772150410125), (12, 3, 5, 1772150410125)");
  const RawSeries pv = read("pv");
  ASSERT_EQ(pv.value.size(), 22U);
  EXPECT_THAT(std::vector(pv.value.begin() + 1, pv.value.begin() + 4),
              ElementsAre(value("pv", 1), 900.0, 5.0));
}

TEST_F(Trap, EpicsOrdersByNanosecondsAndJudgesByTheNameOfTheSeverity) {
  use("epics",
      "INSERT INTO sample VALUES (12, '2026-02-27 00:00:10+00', 900000000, 4, 1, NULL, 9),"
      " (12, '2026-02-27 00:00:10+00', 250000000, 4, 1, NULL, 2),"
      " (12, '2026-02-27 00:00:10+00', 500000000, 1, 1, NULL, 5),"
      " (12, '2026-02-27 00:00:11+00', 0, 4, 1, NULL, 'NaN'),"
      " (12, '2026-02-27 00:00:12+00', 0, 77, 1, NULL, 3)");
  storage::HistorianReader historian = reader();
  const RawSeries pv = read(historian, "pv", 1, 2);
  EXPECT_THAT(pv.value,
              ElementsAre(value("pv", 1), 2.0, IsNan(), 9.0, IsNan(), IsNan(), value("pv", 2)));
  EXPECT_EQ(pv.unknown_quality, 1U);
  EXPECT_THAT(read(historian, "pv", 2, 2, RowBefore::if_held).value,
              ElementsAre(IsNan(), value("pv", 2)))
      << "the sample at or before the start comes first";
}

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
  const std::vector<TagRequest> wanted{
      {"FIC1.pv", Truth::time_us(0), Truth::time_us(kRows - 1), 2 * kRows, RowBefore::no}};
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
    missing = missing || (!finding.ok && finding.hint.starts_with("CREATE INDEX"));
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
