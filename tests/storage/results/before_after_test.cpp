#include <gmock/gmock.h>

#include "storage/results/reports/report_database.hpp"
#include "tests/storage/results/views_fixture.hpp"

namespace loopscope::storage {
namespace {

using core::diagnosis::VerdictCode;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// Windows of 4095 s that end at whole hours; the work is done at hour 20.
class BeforeAfterTest : public ViewsTest {
 protected:
  struct State {
    VerdictCode code = VerdictCode::valve_stiction;
    double error_std = 1.0;
    double harris = 0.5;
    double confidence = 0.9;
  };

  void SetUp() override {
    ViewsTest::SetUp();
    if (database == nullptr) return;
    add_loops({"a"});
    work_at(20);
  }
  void work_at(int hour) {
    database->execute(
        "INSERT INTO loopscope.maintenance_event (loop_id, done_at, kind, description)"
        " SELECT loop_id, '2026-01-01 00:00+00'::timestamptz + interval '1 hour' * " +
        std::to_string(hour) + ", 'valve', 'packing' FROM loopscope.loop");
  }
  void see(const std::vector<int>& hours, const State& state) {
    for (const int hour : hours)
      tell({{.loop = "a",
             .code = state.code,
             .confidence = state.confidence,
             .harris = state.harris,
             .slot_hours = hour,
             .error_std = state.error_std}});
  }
  /// Every analysis up to the work, or after it, has a fitted effect.
  void fit(const std::string& when, const std::string& effect, const std::string& parameters) {
    database->execute(
        "INSERT INTO loopscope.explanation_step (loop_id, slot_end, algorithm_revision,"
        " input_revision, step, effect, parameters, intervals, statement)"
        " SELECT loop_id, slot_end, algorithm_revision, input_revision, 1, '" +
        effect + "', '" + parameters + "', '{}', '' FROM loopscope.analysis WHERE slot_end " +
        when + " '2026-01-01 20:00+00'");
  }
  [[nodiscard]] std::string of(const std::string& column) const {
    judge_repairs();
    return value("SELECT " + column +
                 " FROM loopscope.before_after_maintenance ORDER BY done_at"
                 " LIMIT 1");
  }
  [[nodiscard]] std::vector<std::string> windows(const std::string& side) const {
    return column(
        "SELECT extract(epoch FROM slot_end - '2026-01-01')::integer / 3600"
        " FROM loopscope.maintenance_window WHERE side = '" +
        side + "' ORDER BY maintenance_event_id, number");
  }
};

TEST_F(BeforeAfterTest, WindowsShareNoSampleAndStandNextToTheWork) {
  // A window is longer than an hour: of neighbours every second one is free of the last.
  see({10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20}, {});
  see({21, 22, 23, 24, 25}, {.code = kHealthy});
  EXPECT_THAT(windows("before"), ElementsAre("20", "18", "16", "14", "12", "10"));
  EXPECT_THAT(windows("after"), ElementsAre("22", "24")) << "the window of hour 21 began before";
}

TEST_F(BeforeAfterTest, SixWindowsASideAreEnough) {
  see({2, 4, 6, 8, 10, 12, 14, 16, 18}, {});
  EXPECT_EQ(of("windows_before"), "6");
  EXPECT_THAT(windows("before"), ElementsAre("18", "16", "14", "12", "10", "8"));
}

TEST_F(BeforeAfterTest, OtherWorkBoundsTheWindows) {
  work_at(14);
  see({12, 16, 18, 24, 28}, {});
  work_at(26);
  judge_repairs();
  EXPECT_THAT(column("SELECT windows_before || ' ' || windows_after"
                     " FROM loopscope.before_after_maintenance ORDER BY done_at"),
              ElementsAre("1 2", "2 1", "1 1"));
}

TEST_F(BeforeAfterTest, WorkOfOneTimeIsComparedTogether) {
  see({16, 18, 24, 28}, {});
  work_at(20);
  judge_repairs();
  EXPECT_THAT(column("SELECT windows_before || ' ' || windows_after"
                     " FROM loopscope.before_after_maintenance"),
              ElementsAre("2 2", "2 2"));
}

TEST_F(BeforeAfterTest, WorkWithoutAWindowBetweenIsOneJob) {
  work_at(21);
  work_at(30);
  see({16, 18}, {.error_std = 4.0, .harris = 0.2});
  see({21}, {});  // mixes before and after
  see({24, 26}, {.code = kHealthy, .error_std = 1.0, .harris = 0.8});
  see({34}, {.code = kHealthy});
  judge_repairs();
  EXPECT_EQ(database->rows("SELECT windows_before, windows_after, word"
                           " FROM loopscope.before_after_maintenance ORDER BY done_at"),
            (TextRows{{"2", "2", "fixed"}, {"2", "2", "fixed"}, {"2", "1", "unchanged"}}));
  EXPECT_THAT(column("SELECT to_char(begins_at AT TIME ZONE 'UTC', 'HH24') || ' ' ||"
                     " to_char(ends_at AT TIME ZONE 'UTC', 'HH24')"
                     " FROM loopscope.maintenance_job JOIN loopscope.maintenance_event"
                     " USING (maintenance_event_id) ORDER BY done_at"),
              ElementsAre("20 21", "20 21", "06 06"));
  EXPECT_EQ(ReportDatabase(settings_for(*database)).counts(slot(0)).fixed, 1) << "one job";
}

TEST_F(BeforeAfterTest, FixedWhenTheFaultIsGone) {
  see({16, 18}, {.error_std = 4.0, .harris = 0.2});
  see({24, 26}, {.code = kHealthy, .error_std = 1.0, .harris = 0.8});
  EXPECT_EQ(of("word"), "fixed");
  EXPECT_EQ(of("fault_before"), "valve_stiction");
  EXPECT_EQ(of("fault_after"), "NULL");
  EXPECT_THAT(of("statement"),
              StartsWith("Fixed: valve stiction, which stood in 2 of 2 windows before, is gone;"));
  EXPECT_THAT(of("statement"), HasSubstr("went from 4 to 1 (x 0.25, 90 % interval"));
  EXPECT_EQ(of("round(variance_ratio::numeric, 6)"), "0.062500");
  EXPECT_EQ(of("variance_ratio_low < variance_ratio AND variance_ratio_high < 1"), "t");
}

TEST_F(BeforeAfterTest, WhatIsLeftIsSaid) {
  see({16, 18}, {.error_std = 4.0, .harris = 0.2});
  see({24, 26}, {.code = VerdictCode::sluggish_tuning, .error_std = 1.0, .harris = 0.8});
  EXPECT_EQ(of("word"), "fixed");
  EXPECT_THAT(of("statement"), HasSubstr("What is left: sluggish tuning (2 of 2 windows)."));
}

TEST_F(BeforeAfterTest, ReturnOfTheFaultIsSaid) {
  see({16, 18}, {});
  see({22, 24, 26, 28, 30, 32}, {.code = kHealthy});
  see({40}, {});
  EXPECT_EQ(of("word"), "fixed");
  EXPECT_THAT(of("statement"), HasSubstr("It is back in the newest window, of 2026-01-02 16:00"));
  EXPECT_EQ(of("code_after"), "valve_stiction");
}

TEST_F(BeforeAfterTest, ImprovedWhenTheFaultIsSmaller) {
  see({16, 18, 24, 26}, {});
  fit("<=", "valve_stiction", R"({"S": 5.0, "J": 1.0})");
  fit(">", "valve_deadband", R"({"width": 1.5})");
  EXPECT_EQ(of("word"), "improved");
  EXPECT_THAT(of("statement"), HasSubstr("its friction band went from 5 to 1.5;"));
  EXPECT_EQ(
      database->rows("SELECT windows_before, windows_after, round(before::numeric, 9)::float8,"
                     " round(after::numeric, 9)::float8, is_ratio,"
                     " change_high < 0.5 FROM loopscope.maintenance_figure"
                     " WHERE figure = 'friction_band'"),
      (TextRows{{"2", "2", "5", "1.5", "t", "t"}}));
}

TEST_F(BeforeAfterTest, ImprovedWhenTheErrorIsSmaller) {
  see({16, 18}, {.code = VerdictCode::valve_saturation, .error_std = 3.0, .harris = 0.2});
  see({24, 26}, {.code = VerdictCode::valve_saturation, .error_std = 1.5, .harris = 0.4});
  EXPECT_EQ(of("word"), "improved");
}

TEST_F(BeforeAfterTest, UnchangedWhenItStandsAsBefore) {
  see({16, 18}, {.error_std = 1.0});
  see({24, 26}, {.error_std = 1.1});
  EXPECT_EQ(of("word"), "unchanged");
}

// Noise and load rise together with what no controller could remove: the Harris index says so.
TEST_F(BeforeAfterTest, MoreLoadAloneIsNotWorse) {
  see({16, 18}, {.error_std = 1.0, .harris = 0.5});
  see({24, 26}, {.error_std = 1.4, .harris = 0.6});
  EXPECT_EQ(of("word"), "unchanged");
}

TEST_F(BeforeAfterTest, WorseWhenTheErrorIsLarger) {
  see({16, 18}, {.error_std = 1.0, .harris = 0.5});
  see({24, 26}, {.error_std = 2.5, .harris = 0.2});
  EXPECT_EQ(of("word"), "worse");
}

TEST_F(BeforeAfterTest, WorseWhenSomethingNewIsBroken) {
  see({16, 18}, {.code = kHealthy});
  see({24, 26}, {.code = VerdictCode::valve_deadband});
  EXPECT_EQ(of("word"), "worse");
  EXPECT_THAT(of("statement"), StartsWith("Worse: valve deadband (2 of 2 windows) is new"));
}

TEST_F(BeforeAfterTest, VerdictsBelowTheFlagsConfidenceAreNone) {
  see({16, 18, 24, 26}, {.confidence = 0.2});
  EXPECT_EQ(of("fault_before"), "NULL");
  EXPECT_EQ(of("word"), "unchanged");
}

TEST_F(BeforeAfterTest, NothingIsSaidTooEarly) {
  EXPECT_EQ(of("word"), "NULL");
  EXPECT_THAT(of("statement"), StartsWith("Cannot be compared: no usable window"));
  see({16}, {});
  EXPECT_EQ(of("word"), "NULL");
  EXPECT_THAT(of("statement"), StartsWith("Not judged yet: no window lies wholly after"));
  tell({{.loop = "a", .slot_hours = 24, .usable = false}});
  database->execute(
      "UPDATE loopscope.analysis SET unusable_reason = 'pv is constant'"
      " WHERE NOT usable");
  EXPECT_EQ(of("word"), "NULL");
  EXPECT_THAT(of("statement"), HasSubstr("cannot be used: pv is constant."));
}

// One window a side is little, but not nothing: what is ordinary lends it an interval.
TEST_F(BeforeAfterTest, OneWindowHasAWiderInterval) {
  const std::string width = "variance_ratio_high / variance_ratio_low";
  see({18, 24}, {});
  const double one = std::stod(of(width));
  see({12, 14, 16, 26, 28, 30}, {});
  EXPECT_LT(std::stod(of(width)), one);
}

TEST_F(BeforeAfterTest, RowsOfFormerVersionsCount) {
  see({16, 18, 24, 26}, {});
  EXPECT_EQ(value("SELECT count(error_log_variance_se) FROM loopscope.analysis"), "0");
  EXPECT_EQ(of("word"), "unchanged");
  database->execute("UPDATE loopscope.analysis SET harris_low = NULL");
  EXPECT_EQ(of("word"), "unchanged");
}

}  // namespace
}  // namespace loopscope::storage
