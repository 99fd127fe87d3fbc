#include <algorithm>
#include <gmock/gmock.h>

#include "tests/storage/results/views_fixture.hpp"

/// Since when a verdict stands, and whether a second window confirmed it. Windows are 4095 s long:
/// those of slots an hour apart share samples, those of slots two hours apart do not.
namespace loopscope::storage {
namespace {

using core::diagnosis::VerdictCode;

class VerdictRunTest : public ViewsTest {
 protected:
  [[nodiscard]] TextRows standing() const {
    return database->rows(
        "SELECT status, extract(epoch FROM since - '2026-01-01 00:00+00') / 3600 = trunc(extract("
        "epoch FROM since - '2026-01-01 00:00+00') / 3600), trunc(extract(epoch FROM since -"
        " '2026-01-01 00:00+00') / 3600) FROM loopscope.flagged_loop");
  }
  void expect(const std::string& status, const std::string& since_hour) const {
    EXPECT_EQ(standing(), (TextRows{{status, "t", since_hour}}));
  }
  /// Late rows, or a newer program, judge a slot again.
  void judge_again(int hours, const char* code, int algorithm_more, int input_more) const {
    const std::string more_revision =
        std::to_string(algorithm_more) + ", input_revision + " + std::to_string(input_more);
    database->execute(
        "INSERT INTO loopscope.verdict (loop_id, slot_end, algorithm_revision, input_revision,"
        " analysis_id, code, confidence, summary, reasons, action)"
        " SELECT loop_id, slot_end, algorithm_revision + " +
        more_revision + ", analysis_id, '" + code +
        "', confidence, summary, reasons, action FROM loopscope.verdict"
        " WHERE slot_end = timestamptz '2026-01-01 00:00+00' + interval '1 h' * " +
        std::to_string(hours));
  }
};

TEST_F(VerdictRunTest, WatchUntilASecondWindowThatSharesNoSample) {
  tell({{.loop = "a", .slot_hours = 1}});
  expect("watch", "1");
  tell({{.loop = "a", .slot_hours = 2}});
  expect("watch", "1");
  tell({{.loop = "a", .slot_hours = 3}});
  expect("confirmed", "1");
}

TEST_F(VerdictRunTest, WindowsThatTouchInOneSampleShareIt) {
  tell({{.loop = "a", .slot_hours = 1}, {.loop = "a", .slot_hours = 3}});
  database->execute(
      "UPDATE loopscope.analysis SET window_start = '2026-01-01 01:00+00'"
      " WHERE slot_end = '2026-01-01 03:00+00'");
  expect("watch", "1");
  database->execute(
      "UPDATE loopscope.analysis SET window_start = '2026-01-01 01:00:01+00'"
      " WHERE slot_end = '2026-01-01 03:00+00'");
  expect("confirmed", "1");
}

TEST_F(VerdictRunTest, AnotherVerdictEndsTheRun) {
  tell({{.loop = "a", .slot_hours = 1},
        {.loop = "a", .slot_hours = 3},
        {.loop = "a", .code = VerdictCode::healthy, .slot_hours = 5},
        {.loop = "a", .slot_hours = 7}});
  expect("watch", "7");
  tell({{.loop = "a", .code = VerdictCode::tight_tuning, .slot_hours = 9}});
  expect("watch", "9");
}

TEST_F(VerdictRunTest, AWindowThatCannotBeJudgedSaysNothing) {
  tell({{.loop = "a", .slot_hours = 1},
        {.loop = "a", .code = VerdictCode::insufficient_data, .slot_hours = 5, .usable = false},
        {.loop = "a", .slot_hours = 9}});
  expect("confirmed", "1");
}

TEST_F(VerdictRunTest, OtherLoopsSayNothing) {
  tell({{.loop = "a", .slot_hours = 1},
        {.loop = "b", .code = VerdictCode::healthy, .slot_hours = 2},
        {.loop = "a", .slot_hours = 3}});
  expect("confirmed", "1");
}

TEST_F(VerdictRunTest, TheNewestRevisionOfASlotCounts) {
  tell({{.loop = "a", .slot_hours = 1},
        {.loop = "a", .code = VerdictCode::healthy, .slot_hours = 3},
        {.loop = "a", .slot_hours = 5}});
  expect("watch", "5");
  judge_again(3, "valve_stiction", 0, 1);
  expect("confirmed", "1");
  judge_again(3, "healthy", 1, 0);
  expect("watch", "5");
}

TEST_F(VerdictRunTest, RunsGoThroughMonths) {
  database->execute("SELECT loopscope.make_partitions('2026-01-01', 6)");
  tell({{.loop = "a", .code = VerdictCode::healthy, .slot_hours = 1}});
  for (int day = 1; day < 150; day += 7) tell({{.loop = "a", .slot_hours = 24 * day}});
  expect("confirmed", "24");
}

/// Half a year of slots an hour apart: the key's index holds what is asked.
TEST_F(VerdictRunTest, LongRunsAreReadFromTheIndexAlone) {
  tell({{.loop = "a", .code = VerdictCode::healthy, .slot_hours = 1}});
  std::vector<std::string> others(20);
  std::ranges::generate(others, [n = 0]() mutable { return "other " + std::to_string(++n); });
  add_loops(others);
  database->execute(
      "SELECT loopscope.make_partitions('2026-01-01', 7);"
      "INSERT INTO loopscope.verdict SELECT loop.loop_id, slot_end + k * interval '1 h',"
      " algorithm_revision, 1, k, 'valve_stiction', 1, repeat('x', 300), '{}', '' FROM"
      " loopscope.verdict, generate_series(1, 4320) AS k, loopscope.loop");
  database->execute("VACUUM ANALYZE loopscope.verdict");
  EXPECT_EQ(value("SELECT since FROM loopscope.loop, loopscope.verdict_run(loop_id,"
                  " '2026-06-30 00:00+00', 'valve_stiction') WHERE name = 'a'"),
            value("SELECT timestamptz '2026-01-01 02:00+00'"));
  std::string plan;
  for (const std::string& line :
       column("EXPLAIN (ANALYZE, TIMING OFF) SELECT run.* FROM loopscope.loop, LATERAL"
              " loopscope.verdict_run(loop_id, '2026-06-30 00:00+00', 'valve_stiction') AS run"
              " WHERE name = 'a'")) {
    plan += line + "\n";
  }
  EXPECT_THAT(plan, testing::ContainsRegex("Index Only Scan Backward using verdict_2026_0[1-6]_pkey"
                                           ".*\n.*\n.*\n *Heap Fetches: 0"));
  EXPECT_THAT(
      plan,
      testing::Not(testing::ContainsRegex("(Seq Scan|Index Scan)[A-Za-z0-9_ ]* on verdict_2026")));
}

}  // namespace
}  // namespace loopscope::storage
