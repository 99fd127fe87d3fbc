#include <algorithm>
#include <array>
#include <gmock/gmock.h>
#include <optional>
#include <random>

#include "tests/storage/results/views_fixture.hpp"

/// Since when a fault is there, and whether a second window confirmed it. Windows are 4095 s long:
/// those of slots an hour apart share samples, those of slots two hours apart do not.
namespace loopscope::storage {
namespace {

using core::diagnosis::VerdictCode;

std::vector<std::string> names_of(std::size_t loops) {
  std::vector<std::string> names(loops);
  std::ranges::generate(names, [n = 0]() mutable { return "other " + std::to_string(++n); });
  return names;
}

/// What a slot's window said.
struct Said {
  int hours = 0;
  VerdictCode code = VerdictCode::healthy;
};

/// 1: speaks for a fault of friction; -1: against it; 0: says nothing of it.
int vote(VerdictCode code) {
  switch (code) {
    case VerdictCode::valve_stiction:
    case VerdictCode::valve_deadband:
      return 1;
    case VerdictCode::healthy:
    case VerdictCode::tight_tuning:
      return -1;
    default:
      return 0;
  }
}

int run_begins(const std::vector<Said>& history) {
  int begins = history.back().hours;
  std::optional<int> contrary;
  for (auto said = history.rbegin(); said != history.rend(); ++said) {
    if (vote(said->code) > 0) {
      begins = said->hours;
      contrary.reset();
    }
    if (vote(said->code) < 0) {
      if (contrary && *contrary - said->hours > 1) return begins;
      if (!contrary) contrary = said->hours;
    }
  }
  return begins;
}

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
  /// The rows of a loop of that number, as the one that is stored has them.
  void write(int loop, const std::vector<Said>& history) const {
    std::string said;
    for (const Said& each : history)
      said += (said.empty() ? "(" : ", (") + std::to_string(each.hours) + ", '" +
              std::string(name(each.code)) + "')";
    const std::string rows = " FROM (VALUES " + said +
                             ") AS said (hours, code) CROSS JOIN LATERAL (SELECT timestamptz"
                             " '2026-01-01 00:00+00' + interval '1 h' * hours) AS slot (ends), ";
    const auto insert = [&](const std::string& table, const std::string& changed) {
      database->execute(
          "INSERT INTO loopscope." + table +
          " SELECT (jsonb_populate_record(row, jsonb_build_object('loop_id', " +
          std::to_string(loop) + ", 'slot_end', ends, " + changed + "))).*" + rows + "loopscope." +
          table +
          " AS row WHERE row.loop_id = (SELECT loop_id FROM loopscope.loop WHERE name = 'teller')");
    };
    insert("verdict", "'code', said.code");
    insert("analysis", "'window_start', ends - interval '4095 s', 'window_end', ends");
  }
  [[nodiscard]] std::string since_of(int loop, const Said& newest) const {
    return value(
        "SELECT extract(epoch FROM since - '2026-01-01 00:00+00')::int / 3600"
        " FROM loopscope.verdict_run(" +
        std::to_string(loop) + ", timestamptz '2026-01-01 00:00+00' + interval '1 h' * " +
        std::to_string(newest.hours) + ", '" + std::string(name(newest.code)) + "')");
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

/// What ends a run is what confirms one: a second window that shares no sample.
TEST_F(VerdictRunTest, TwoWindowsThatSayOtherwiseEndTheRunAndOneDoesNot) {
  tell({{.loop = "a", .slot_hours = 1},
        {.loop = "a", .slot_hours = 3},
        {.loop = "a", .code = VerdictCode::healthy, .slot_hours = 5},
        {.loop = "a", .slot_hours = 7}});
  expect("confirmed", "1");
  tell({{.loop = "a", .code = VerdictCode::healthy, .slot_hours = 9},
        {.loop = "a", .code = VerdictCode::tight_tuning, .slot_hours = 10},
        {.loop = "a", .slot_hours = 11}});
  expect("confirmed", "1");
  tell({{.loop = "a", .code = VerdictCode::healthy, .slot_hours = 13},
        {.loop = "a", .code = VerdictCode::tight_tuning, .slot_hours = 15},
        {.loop = "a", .slot_hours = 17}});
  expect("watch", "17");
  tell({{.loop = "a", .code = VerdictCode::tight_tuning, .slot_hours = 19}});
  expect("confirmed", "15");
}

TEST_F(VerdictRunTest, WhatOneRepairRemovesIsOneRun) {
  tell({{.loop = "a", .code = VerdictCode::valve_deadband, .slot_hours = 1},
        {.loop = "a", .code = VerdictCode::nonlinear_unexplained, .slot_hours = 3},
        {.loop = "a", .code = VerdictCode::unexplained, .slot_hours = 5},
        {.loop = "a", .slot_hours = 7}});
  expect("confirmed", "1");
}

/// Random histories of all that may be said, against the rule in few words.
TEST_F(VerdictRunTest, RandomHistoriesHaveTheRunsOfTheRule) {
  constexpr std::array kSaid{VerdictCode::valve_stiction,
                             VerdictCode::valve_deadband,
                             VerdictCode::healthy,
                             VerdictCode::tight_tuning,
                             VerdictCode::nonlinear_unexplained,
                             VerdictCode::insufficient_data};
  std::mt19937 random(1);
  tell({{.loop = "teller"}});
  add_loops(names_of(60));
  for (int loop = 2; loop <= 61; ++loop) {
    std::vector<Said> history;
    for (int hours = 0; history.size() < 14; hours += 1 + static_cast<int>(random() % 2))
      history.push_back({hours, kSaid[random() % (history.size() < 13 ? kSaid.size() : 2)]});
    write(loop, history);
    EXPECT_EQ(since_of(loop, history.back()), std::to_string(run_begins(history))) << loop;
  }
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
        {.loop = "a", .code = VerdictCode::healthy, .slot_hours = 5},
        {.loop = "a", .slot_hours = 7}});
  expect("watch", "7");
  judge_again(3, "valve_stiction", 0, 1);
  expect("confirmed", "1");
  judge_again(3, "healthy", 1, 0);
  expect("watch", "7");
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
  add_loops(names_of(20));
  database->execute(
      "SELECT loopscope.make_partitions('2026-01-01', 7);"
      "INSERT INTO loopscope.verdict SELECT loop.loop_id, slot_end + k * interval '1 h',"
      " algorithm_revision, 1, k, 'valve_stiction', 1, repeat('x', 300), '{}', '' FROM"
      " loopscope.verdict, generate_series(1, 4320) AS k, loopscope.loop");
  // Rows are visible to all once their commit has been written to disk.
  database->execute("CHECKPOINT");
  database->execute("VACUUM ANALYZE loopscope.verdict");
  EXPECT_EQ(value("SELECT since FROM loopscope.loop, loopscope.verdict_run(loop_id,"
                  " '2026-06-30 00:00+00', 'valve_stiction') WHERE name = 'a'"),
            value("SELECT timestamptz '2026-01-01 02:00+00'"));
  std::string plan;
  for (const std::string& line :
       column("EXPLAIN (ANALYZE, TIMING OFF) SELECT run.* FROM loopscope.loop, LATERAL"
              " loopscope.verdict_run(loop_id, '2026-06-30 00:00+00', 'valve_stiction') AS run"
              " WHERE name = 'a'")) {
    if (line.find("never executed") == std::string::npos) plan += line + "\n";
  }
  EXPECT_THAT(plan, testing::ContainsRegex("Index Only Scan Backward using verdict_2026_0[1-6]_pkey"
                                           ".*\n.*\n.*\n *Heap Fetches: 0"));
  EXPECT_THAT(
      plan,
      testing::Not(testing::ContainsRegex("(Seq Scan|Index Scan)[A-Za-z0-9_ ]* on verdict_2026")));
}

}  // namespace
}  // namespace loopscope::storage
