#include <gmock/gmock.h>

#include "core/signal/grid.hpp"
#include "storage/historian/setup/check_historian.hpp"
#include "tests/historians/trap.hpp"

namespace loopscope::tests {
namespace {

using core::signal::Hold;
using core::signal::RawSeries;
using storage::RowBefore;
using storage::TagRequest;
using testing::ElementsAre;
using testing::IsNan;

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
  database->execute("DROP TABLE sqlt_data_3_2026_04");
  EXPECT_EQ(read(historian, "pv").value.size(), 5U) << "dropped while the list still has it";
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
    missing =
        missing || (finding.warning && finding.index_sql.starts_with("CREATE INDEX CONCURRENTLY ON"
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

}  // namespace
}  // namespace loopscope::tests
