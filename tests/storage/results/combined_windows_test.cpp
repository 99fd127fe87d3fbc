#include <algorithm>
#include <gmock/gmock.h>
#include <map>
#include <random>

#include "core/diagnosis/odds/combined_odds.hpp"
#include "core/diagnosis/odds/log_odds.hpp"
#include "tests/storage/results/results_fixture.hpp"

/// What analysis keeps of several windows against core/diagnosis/odds/combined_odds.
namespace loopscope::storage {
namespace {

namespace diagnosis = core::diagnosis;
using diagnosis::VerdictCode;

constexpr double kMicrosecondsPerSecond = 1e6;

/// A window an hour, of 4096 s: seven eighths of it are new.
struct Look {
  int hour = 1;
  double stiction = 0.5;
  bool with_model = true;
  bool judged = true;
  int revision = core::kAlgorithmRevision;  ///< of the program
};

class CombinedWindowsTest : public ResultsTest {
 protected:
  static double evidence(double probability, double prior) {
    return diagnosis::log_odds_of(probability) - diagnosis::log_odds_of(prior);
  }

  static std::vector<diagnosis::CauseReport> causes(double stiction) {
    const double healthy = 1.0 - stiction;
    return {{VerdictCode::valve_stiction, stiction, 0.15, {}, {}, evidence(stiction, 0.15)},
            {VerdictCode::healthy, healthy, 0.2, {}, {}, evidence(healthy, 0.2)}};
  }

  static diagnosis::Verdict verdict_of(const Look& look) {
    diagnosis::Verdict verdict;
    verdict.causes = causes(look.stiction);
    return verdict;
  }

  static AnalysisRecord record_of(const Look& look, const std::string& digest) {
    AnalysisRecord record = record_at(slot(look.hour), digest);
    record.algorithm_revision = look.revision;
    if (look.judged) record.diagnosis.verdict.causes = causes(look.stiction);
    record.diagnosis.verdict.priors = {0.2, 0.15};
    if (look.with_model) explain(record);
    return record;
  }

  void finish(const Look& look, const std::string& digest, const std::vector<Look>& revised = {}) {
    database->execute(kEndLeases);
    ResultsDatabase results = connect();
    CompletedLoop loop = completed(claim_all(results).at(0), slot(look.hour), digest);
    loop.record = record_of(look, digest);
    for (const Look& earlier : revised)
      loop.revised.push_back(record_of(earlier, digest + std::to_string(earlier.hour)));
    results.finish(std::vector{loop}, {});
  }

  /// Rows of (hour, stiction, windows) as core comes to them.
  static TextRows expected(const std::map<int, Look>& looks) {
    TextRows rows;
    std::optional<diagnosis::CombinedOdds> combined;
    for (const auto& [hour, look] : looks) {
      if (!look.judged) {
        rows.push_back({std::to_string(hour), "NULL", "NULL"});
        continue;
      }
      const double end_s = static_cast<double>(slot(hour)) / kMicrosecondsPerSecond;
      const diagnosis::JudgedWindow window{end_s - 4095.0, end_s, look.with_model,
                                           diagnosis::evidence_of(verdict_of(look))};
      const bool alone = diagnosis::stands_alone(combined, window);
      combined = diagnosis::combine(combined, window);
      const double together = *diagnosis::probabilities_of(*combined, {0.2, 0.15})[1];
      rows.push_back({std::to_string(hour), rounded(alone ? look.stiction : together),
                      rounded(*combined->windows[1])});
    }
    return rows;
  }

  static std::string rounded(double value) {
    std::string text = std::to_string(value);
    return text.substr(0, text.size() - 2);
  }

  [[nodiscard]] TextRows stored(std::optional<int> revision = std::nullopt) const {
    return database->rows(
        std::string(
            "SELECT extract(epoch FROM slot_end - '2026-01-01 00:00:00+00')::integer / 3600,"
            " trunc(combined_probabilities[2]::numeric, 4), trunc(combined_windows[2]::numeric, 4) "
            "FROM loopscope.analysis") +
        (revision ? " WHERE algorithm_revision = " + std::to_string(*revision) : std::string()) +
        " ORDER BY slot_end");
  }

  /// Equal to a digit in the third place: four bytes each.
  static void expect_same(const TextRows& found, const TextRows& wanted) {
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_EQ(found[k][0], wanted[k][0]);
      for (const std::size_t column : {1u, 2u}) {
        if (wanted[k][column] == "NULL" || found[k][column] == "NULL")
          EXPECT_EQ(found[k][column], wanted[k][column]);
        else
          EXPECT_NEAR(std::stod(found[k][column]), std::stod(wanted[k][column]), 3e-4);
      }
    }
  }
};

TEST_F(CombinedWindowsTest, EachSlotHoldsWhatAllWindowsUpToItSay) {
  add_loops({"a"});
  std::map<int, Look> looks;
  for (const Look& look : {Look{1, 0.4}, Look{2, 0.7}, Look{3, 0.6, false},
                           Look{4, 0.0, false, false}, Look{5, 0.8}, Look{9, 0.1}}) {
    looks[look.hour] = look;
    finish(look, "d" + std::to_string(look.hour));
  }
  expect_same(stored(), expected(looks));
  EXPECT_EQ(value("SELECT combined_confidence = combined_probabilities[2]::float8"
                  " AND fault_probability = 1 - combined_probabilities[1]::float8"
                  " FROM loopscope.latest_verdict"),
            "t");
}

/// The view finds the code's place in a list of its own.
TEST_F(CombinedWindowsTest, TheCombinedConfidenceIsThatOfTheCode) {
  add_loops({"a"});
  int hour = 0;
  for (const VerdictCode code : diagnosis::all_verdict_codes()) {
    if (code > VerdictCode::nonlinear_unexplained) break;
    ++hour;
    database->execute(kEndLeases);
    ResultsDatabase results = connect();
    // A window of its own each time: the ones before are forgotten.
    CompletedLoop loop = completed(claim_all(results).at(0), slot(48 * hour), "d");
    diagnosis::Verdict& verdict = loop.record->diagnosis.verdict;
    verdict.code = code;
    verdict.causes = {{code, 0.5 + 0.01 * hour, 0.15, {}, {}}};
    results.finish(std::vector{loop}, {});
    EXPECT_EQ(value("SELECT round(combined_confidence::numeric, 4) FROM loopscope.latest_verdict"),
              "0." + std::to_string(5000 + 100 * hour))
        << diagnosis::name(code);
  }
}

TEST_F(CombinedWindowsTest, LateDataReachesEverySlotBehindIt) {
  add_loops({"a"});
  std::map<int, Look> looks;
  for (int hour = 1; hour <= 4; ++hour) {
    looks[hour] = {hour, 0.5};
    finish(looks[hour], "d" + std::to_string(hour));
  }
  looks[2] = {2, 0.95};
  looks[5] = {5, 0.6};
  finish(looks[5], "d5", {looks[2]});
  expect_same(stored(), expected(looks));
}

TEST_F(CombinedWindowsTest, SlotsInAnyOrderComeToTheSame) {
  add_loops({"a"});
  std::map<int, Look> looks;
  std::vector<int> hours = {1, 2, 3, 4, 5, 6};
  std::mt19937 random(7);
  std::ranges::shuffle(hours, random);
  for (const int hour : hours) {
    looks[hour] = {hour, 0.1 * hour, hour % 2 == 0};
    // The newest slot brings the others in as revised ones.
    finish({9, 0.5}, "n" + std::to_string(hour), {looks[hour]});
  }
  looks[9] = {9, 0.5};
  expect_same(stored(), expected(looks));
}

/// To the last digit: slots that were reached in one transaction or in several are one.
TEST_F(CombinedWindowsTest, AnUndisturbedRunStoresTheSameDigits) {
  const auto digits = [&] {
    return database->rows(
        "SELECT loop_id, slot_end, combined_evidence, combined_windows, combined_probabilities"
        " FROM loopscope.analysis ORDER BY loop_id, slot_end");
  };
  add_loops({"a"});
  for (int hour = 1; hour <= 7; ++hour)
    finish({hour, hour == 3 ? 0.83 : 0.3 + 0.0617 * hour}, "d" + std::to_string(hour));
  finish({8, 0.77}, "d8", {{3, 0.3 + 0.0617 * 3}});
  const TextRows revised = digits();
  database->execute(
      "DELETE FROM loopscope.verdict; DELETE FROM loopscope.bicoherence_peak;"
      " DELETE FROM loopscope.explanation_step; DELETE FROM loopscope.analysis;"
      "UPDATE loopscope.schedule SET last_slot_end = NULL, result_slot_end = NULL");
  for (int hour = 1; hour <= 8; ++hour)
    finish({hour, hour == 8 ? 0.77 : 0.3 + 0.0617 * hour}, "u" + std::to_string(hour));
  EXPECT_EQ(digits(), revised);
}

/// A slot of the same samples says what the one before it said.
TEST_F(CombinedWindowsTest, NothingNewChangesNothing) {
  add_loops({"a"});
  finish({1, 0.4}, "d1");
  database->execute(kEndLeases);
  ResultsDatabase results = connect();
  CompletedLoop loop = completed(claim_all(results).at(0), slot(2), "d2");
  loop.record = record_of({2, 0.9}, "d2");
  const AnalysisRecord first = record_of({1, 0.4}, "d1");
  loop.record->window_start_us = first.window_start_us;
  loop.record->window_end_us = first.window_end_us;
  results.finish(std::vector{loop}, {});
  const TextRows rows = stored();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1][1], rows[0][1]);
  EXPECT_EQ(rows[1][2], rows[0][2]);
}

/// A second version of each row would cost as much as the first one.
TEST_F(CombinedWindowsTest, ANewestSlotIsWrittenOnce) {
  add_loops({"a"});
  for (const int hour : {1, 2, 3}) finish({hour, 0.4}, "d" + std::to_string(hour));
  EXPECT_EQ(database->rows("SELECT ctid FROM loopscope.analysis ORDER BY slot_end"),
            (TextRows{{"(0,1)"}, {"(0,2)"}, {"(0,3)"}}));
}

TEST_F(CombinedWindowsTest, AnotherRevisionBeginsAnew) {
  add_loops({"a"});
  finish({1, 0.9}, "d1");
  database->execute("UPDATE loopscope.analysis SET algorithm_revision = 1");
  finish({2, 0.3}, "d2");
  const TextRows rows = stored();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(std::stod(rows[1][1]), 0.3, 3e-4);
  EXPECT_NEAR(std::stod(rows[1][2]), 1.0, 3e-4);
}

/// Workers of the version before go on until they are replaced, and take loops in turn.
TEST_F(CombinedWindowsTest, TwoVersionsSideBySideCombineTheirOwnWindows) {
  add_loops({"a"});
  std::map<int, std::map<int, Look>> looks;  // by revision
  for (const int hour : {1, 2, 3, 4, 5, 6, 7}) {
    const int revision = core::kAlgorithmRevision - hour % 2;
    const Look look{.hour = hour, .stiction = 0.25 + 0.1 * hour, .revision = revision};
    looks[revision][hour] = look;
    finish(look, "d" + std::to_string(hour));
    EXPECT_EQ(value("SELECT algorithm_revision FROM loopscope.latest_verdict"),
              std::to_string(revision));
  }
  for (const auto& [revision, own] : looks) expect_same(stored(revision), expected(own));
}

}  // namespace
}  // namespace loopscope::storage
