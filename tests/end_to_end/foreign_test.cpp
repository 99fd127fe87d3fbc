#include <chrono>
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

#include "tests/end_to_end/plant.hpp"
#include "tests/support/mariadb.hpp"
#include "tests/support/mariadb_tables.hpp"

namespace loopscope::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The rows of public.history as Ignition would have them.
constexpr const char* kIgnition = R"(
    CREATE SCHEMA gateway;
    CREATE TABLE sqlth_te AS SELECT row_number() OVER (ORDER BY tag) AS id, tag AS tagpath,
      9 AS querymode, 0::bigint AS created FROM (SELECT DISTINCT tag FROM history) AS t;
    CREATE TABLE sqlth_partitions AS SELECT 'sqlt_data_1_2026_01' AS pname,
      (extract(epoch FROM min(time)) * 1000)::bigint AS start_time,
      (extract(epoch FROM max(time)) * 1000)::bigint AS end_time FROM history;
    CREATE TABLE sqlt_data_1_2026_01 AS SELECT e.id AS tagid, NULL::bigint AS intvalue,
      h.value AS floatvalue, NULL::text AS stringvalue, 192 AS dataintegrity,
      (extract(epoch FROM h.time) * 1000)::bigint AS t_stamp
      FROM history AS h JOIN sqlth_te AS e ON e.tagpath = h.tag)";

constexpr const char* kHistorians = R"({"results": {"connection": "@RESULTS@"}, "historians": [
    {"name": "plant", "connection": "@CONNECTION@"},
    {"name": "scada", "connection": "@CONNECTION@", "table": "gateway.history",
     "time_kind": "timestamp_utc"},
    {"name": "gateway", "connection": "@CONNECTION@", "preset": "ignition",
     "table": "gateway.sqlth_1_data", "partition_table": "gateway.sqlth_partitions",
     "tag_table": "gateway.sqlth_te", "interpolation": "sample"}],
    "schedule": {"poll_s": 0.2, "settle_s": 0}})";

/// Loops of a native historian, with their rows in a MariaDB besides: the narrow table scada, and
/// Ignition's.
class ForeignHistorians : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_mariadb()) GTEST_SKIP() << kNoMariaDb;
    wait_for_hour_with(std::chrono::seconds(40));
    mariadb.emplace();
    plant.import_loop("FIC101", 1000, 1);
    plant.import_loop("TIC102", 1000, 2);
    plant.sql(kIgnition);
    std::string tables;
    for (const char* table : {"history", "sqlth_te", "sqlth_partitions", "sqlt_data_1_2026_01"})
      tables += as_create(plant.database(), table) + as_insert(plant.database(), table);
    mariadb->execute(tables +
                     "ALTER TABLE history ADD KEY (tag, time, value, quality);"
                     "ALTER TABLE sqlt_data_1_2026_01 ADD PRIMARY KEY (tagid, t_stamp)");
    plant.sql(mariadb->server_sql() +
              "DROP TABLE sqlth_te, sqlth_partitions, sqlt_data_1_2026_01;"
              "IMPORT FOREIGN SCHEMA plant FROM SERVER mariadb INTO gateway");
    plant.write_settings(kHistorians);
  }
  /// The loops of the plant again, read from there.
  void add_loops(const std::string& source, const std::string& suffix) const {
    plant.sql(
        "insert into loopscope.loop (name, source, sp_tag, pv_tag, op_tag, period_s, interval_s)"
        " select name || '" +
        suffix + "', '" + source +
        "', sp_tag, pv_tag, op_tag, period_s, interval_s from loopscope.loop"
        " where source = 'plant'");
  }
  /// The columns in which results of loops of one name differ, whatever their historian.
  [[nodiscard]] std::string different_columns() const {
    return plant.sql(
        "select string_agg(distinct key, ' ') from (select key from loopscope.analysis as a"
        " join loopscope.loop as l using (loop_id), jsonb_each(to_jsonb(a)) group by left(l.name, "
        "6),"
        " key having count(distinct value) > 1) as of_name"
        " where key not in ('loop_id', 'analysis_id', 'analysed_at') and key not like '%\\_ms'");
  }

  Plant plant;
  std::optional<MariaDb> mariadb;
};

TEST_F(ForeignHistorians, OnceRunAndWindowGiveWhatTheNativeOneGives) {
  add_loops("scada", " in MariaDB");
  add_loops("gateway", " in Ignition");
  const ProgramResult checked = plant.loopscope("check-config");
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  const ProgramResult once = plant.loopscope("once");
  EXPECT_EQ(once.exit_code, 0) << once.err;
  EXPECT_EQ(plant.sql("select count(*) from loopscope.analysis"), "6");
  EXPECT_EQ(different_columns(), "");
  const std::string window = plant.loopscope("window", {"--loop", "FIC101"}).out;
  EXPECT_GT(window.size(), 10'000U);
  EXPECT_EQ(plant.loopscope("window", {"--loop", "FIC101 in MariaDB"}).out, window);
  EXPECT_EQ(plant.loopscope("window", {"--loop", "FIC101 in Ignition"}).out, window);

  add_loops("scada", " once more");
  BackgroundProgram daemon(plant.command_line("run"), plant.folder() / "daemon.log");
  for (int tries = 0; tries < 200 && plant.sql("select count(*) from loopscope.analysis") != "8";
       ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(30), 0) << content_of(plant.folder() / "daemon.log");
  EXPECT_EQ(plant.sql("select count(*) from loopscope.analysis"), "8");
  EXPECT_EQ(different_columns(), "");

  plant.sql("drop foreign table gateway.sqlt_data_1_2026_01");
  const ProgramResult lacking = plant.loopscope("check-config");
  EXPECT_EQ(lacking.exit_code, 4) << lacking.out;
  EXPECT_THAT(lacking.out,
              AllOf(HasSubstr("none of the tables that gateway.sqlth_partitions lists"),
                    HasSubstr("IMPORT FOREIGN SCHEMA")));

  mariadb.reset();
  const ProgramResult away = plant.loopscope("check-config");
  EXPECT_EQ(away.exit_code, 4) << away.out;
  EXPECT_THAT(away.out + away.err, AllOf(HasSubstr("failed to connect to MySQL"),
                                         HasSubstr("HINT: the server behind a foreign table")));
}

}  // namespace
}  // namespace loopscope::tests
