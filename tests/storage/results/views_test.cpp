#include <gmock/gmock.h>

#include "tests/storage/results/views_fixture.hpp"

namespace loopscope::storage {
namespace {

using core::diagnosis::VerdictCode;
using testing::ElementsAre;

std::string state_of(const std::string& loop) {
  return "SELECT state FROM loopscope.monitor_health WHERE loop_name = '" + loop + "'";
}

TEST_F(ViewsTest, BeforeAndAfterMaintenance) {
  // Slots at hours 2, 4, 8 and 10 with windows of 4095 s; work at 5:00 and at 9:00.
  tell({{.loop = "a", .harris = 0.2, .slot_hours = 2, .error_std = 3},
        {.loop = "a", .harris = 0.2, .slot_hours = 4, .error_std = 4},
        {.loop = "a", .code = VerdictCode::healthy, .harris = 0.9, .slot_hours = 8, .error_std = 1},
        {.loop = "a",
         .code = VerdictCode::healthy,
         .harris = 0.8,
         .slot_hours = 10,
         .error_std = 2}});
  database->execute(
      "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description)"
      " SELECT loop_id, done_at, 'valve', 'new packing' FROM loopscope.loop, unnest("
      "'{2026-01-01 05:00+00,2026-01-01 09:00+00}'::timestamptz[]) AS done_at");
  EXPECT_EQ(database->rows("SELECT code_before, code_after, error_std_before, error_std_after,"
                           " error_std_ratio, harris_low_before, harris_low_after"
                           " FROM loopscope.before_after_maintenance ORDER BY done_at"),
            (TextRows{{"valve_stiction", "healthy", "4", "1", "0.25", "0.2", "0.9"},
                      {"healthy", "NULL", "1", "NULL", "NULL", "0.9", "NULL"}}))
      << "the window of hour 10 began before the second work was done";
}

TEST_F(ViewsTest, UnusableAnalysesAreNotCompared) {
  tell({{.loop = "a", .slot_hours = 2, .error_std = 3},
        {.loop = "a", .slot_hours = 4, .error_std = 4, .usable = false}});
  database->execute(
      "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description)"
      " SELECT loop_id, '2026-01-01 05:00+00', 'tuning', 'x' FROM loopscope.loop");
  EXPECT_EQ(value("SELECT error_std_before FROM loopscope.before_after_maintenance"), "3");
}

TEST_F(ViewsTest, MembersOfAPlantOscillation) {
  add_loops({"a", "b"});
  database->execute(
      "INSERT INTO loopscope.plant_oscillation (slot_end, algorithm_revision, number, period_s,"
      " loop_ids, strengths, lags_s, source_loop_id, statement)"
      " SELECT '2026-01-01', 1, 1, 40, array_agg(loop_id ORDER BY name), '{0.5,0.75}', '{0,3}',"
      " min(loop_id), 'a leads' FROM loopscope.loop");
  EXPECT_EQ(database->rows("SELECT loop_name, strength, lag_s, is_source"
                           " FROM loopscope.plant_oscillation_member ORDER BY lag_s"),
            (TextRows{{"a", "0.5", "0", "t"}, {"b", "0.75", "3", "f"}}));
}

TEST_F(ViewsTest, DataQualityIsOfTheNewestAnalysis) {
  tell({{.loop = "a", .slot_hours = 1}, {.loop = "a", .slot_hours = 2, .usable = false}});
  EXPECT_EQ(database->rows("SELECT loop_name, usable, missing_fraction, flags[1], samples"
                           " FROM loopscope.data_quality"),
            (TextRows{{"a", "f", "0.25", "sp_missing", "4096"}}));
}

TEST_F(ViewsTest, HealthOfTheMonitorItself) {
  tell({{.loop = "ok"},
        {.loop = "dead", .code = VerdictCode::insufficient_data, .usable = false},
        {.loop = "off"}});
  add_loops({"failing", "new", "late", "held"});
  Catalogue(settings_for(*database)).set_enabled(std::vector<std::string>{"off"}, false);
  database->execute(
      "UPDATE loopscope.schedule SET visible_at = now() - interval '3 hours', attempts = 2,"
      " last_error = 'tag unknown' WHERE loop_id ="
      " (SELECT loop_id FROM loopscope.loop WHERE name = 'failing');"
      "UPDATE loopscope.schedule SET visible_at = now() - interval '3 hours' WHERE loop_id ="
      " (SELECT loop_id FROM loopscope.loop WHERE name = 'late');"
      "UPDATE loopscope.schedule SET visible_at = now() + interval '1 hour', owner = 'w'"
      " WHERE loop_id = (SELECT loop_id FROM loopscope.loop WHERE name = 'held')");
  EXPECT_EQ(value(state_of("ok")), "ok");
  EXPECT_EQ(value(state_of("dead")), "dead_data");
  EXPECT_EQ(value(state_of("off")), "disabled");
  EXPECT_EQ(value(state_of("failing")), "failing");
  EXPECT_EQ(value(state_of("new")), "never_analysed");
  EXPECT_EQ(value(state_of("late")), "overdue");
  EXPECT_EQ(database->rows("SELECT failures, last_error, overdue_s BETWEEN 10800 AND 10860,"
                           " never_analysed FROM loopscope.monitor_health"
                           " WHERE loop_name = 'failing'"),
            (TextRows{{"2", "tag unknown", "t", "t"}}));
  EXPECT_EQ(database->rows("SELECT leased, overdue_s, age_s, owner FROM loopscope.monitor_health"
                           " WHERE loop_name = 'held'"),
            (TextRows{{"t", "0", "NULL", "w"}}));
  EXPECT_EQ(value("SELECT age_s = extract(epoch FROM now() - last_slot_end)::float8"
                  " FROM loopscope.monitor_health WHERE loop_name = 'ok'"),
            "t");
}

TEST_F(ViewsTest, LatestVerdictPrefersTheNewestAlgorithm) {
  tell({{.loop = "a"}});
  database->execute(
      "INSERT INTO loopscope.analysis (loop_id, slot_end, algorithm_revision, fence, "
      "program_version,"
      " settings, input_digest, fetch_ms, analyse_ms, window_start, window_end, samples, "
      "interval_s,"
      " usable, flags, oscillating) SELECT loop_id, slot_end, algorithm_revision + 1, fence,"
      " program_version, settings, input_digest, fetch_ms, analyse_ms, window_start, window_end,"
      " samples, interval_s, usable, flags, oscillating FROM loopscope.analysis;"
      "INSERT INTO loopscope.verdict SELECT loop_id, slot_end, algorithm_revision + 1, 1, 2,"
      " 'healthy', 1, '', '{}', '' FROM loopscope.verdict");
  EXPECT_THAT(column("SELECT code FROM loopscope.latest_verdict"), ElementsAre("healthy"));
}

TEST_F(ViewsTest, LatestVerdictOfADroppedMonthIsNone) {
  tell({{.loop = "a"}});
  database->execute("DELETE FROM loopscope.verdict; DELETE FROM loopscope.analysis");
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.latest_verdict"), "0");
  EXPECT_EQ(value(state_of("a")), "ok");
}

// One partition a loop: years of history must not make the everyday question slow.
TEST_F(ViewsTest, LatestVerdictProbesOnePartitionPerLoop) {
  database->execute("SELECT loopscope.make_partitions('2025-01-01', 24)");
  tell({{.loop = "a"}});
  std::string plan;
  for (const std::string& line : column(
           "EXPLAIN (ANALYZE, COSTS OFF, TIMING OFF) SELECT code FROM loopscope.latest_verdict")) {
    plan += line + "\n";
  }
  int executed = 0;
  for (std::size_t at = plan.find("on verdict_20"); at != std::string::npos;
       at = plan.find("on verdict_20", at + 1)) {
    const std::string line = plan.substr(at, plan.find('\n', at) - at);
    if (line.find("never executed") == std::string::npos) ++executed;
  }
  EXPECT_EQ(executed, 1) << plan;
}

}  // namespace
}  // namespace loopscope::storage
