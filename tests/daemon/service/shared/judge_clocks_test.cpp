#include "daemon/service/shared/judge_clocks.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using Results = ClockJudgement::Results;
constexpr double kHours = 3600.0;

ClockReading host(double ahead_s) {
  return {"host h", ahead_s};
}

/// "believed", "wrong" or "open", then who else is wrong.
std::string judged(double host_s, const std::vector<double>& historians_s,
                   const storage::AcceptedClocks& accepted = {}) {
  std::vector<ClockReading> historians;
  for (std::size_t k = 0; k < historians_s.size(); ++k)
    historians.push_back({"historian " + std::to_string(k), historians_s[k]});
  const ClockJudgement judgement = judge_clocks(host(host_s), historians, accepted);
  std::string words = judgement.results == Results::believed ? "believed"
                      : judgement.results == Results::wrong  ? "wrong"
                                                             : "open";
  if (judgement.host_is_wrong) words += ", host";
  for (const ClockReading& historian : judgement.wrong_historians) words += ", " + historian.clock;
  return words;
}

TEST(JudgeClocks, TenMinutesAreNoDifference) {
  EXPECT_EQ(judged(0, {0, 0}), "believed");
  EXPECT_EQ(judged(600, {-600, 600}), "believed");
  EXPECT_EQ(judged(-599, {}), "believed");
}

TEST(JudgeClocks, TheOneThatDiffersFromTwoIsWrong) {
  EXPECT_EQ(judged(5 * kHours, {5 * kHours}), "wrong");
  EXPECT_EQ(judged(5 * kHours, {0}), "believed, host");
  EXPECT_EQ(judged(0, {5 * kHours}), "believed, historian 0");
  EXPECT_EQ(judged(-700 * 24 * kHours, {-700 * 24 * kHours + 300}), "wrong");
}

TEST(JudgeClocks, WhereNoTwoAgreeNobodyIsBelieved) {
  EXPECT_EQ(judged(5 * kHours, {}), "open") << "no witness";
  EXPECT_EQ(judged(5 * kHours, {-2 * kHours}), "open, historian 0");
  EXPECT_EQ(judged(5 * kHours, {5 * kHours, 0}), "open") << "two against two";
}

TEST(JudgeClocks, HistoriansDecideByTheirNumber) {
  EXPECT_EQ(judged(5 * kHours, {5 * kHours, 5 * kHours, 0}), "wrong");
  EXPECT_EQ(judged(5 * kHours, {5 * kHours, 0, 0}), "believed, host");
  EXPECT_EQ(judged(5 * kHours, {5 * kHours, -9 * kHours}), "wrong, historian 1");
  EXPECT_EQ(judged(0, {5 * kHours, 5 * kHours, 5 * kHours}),
            "believed, historian 0, historian 1, historian 2")
      << "host and results server agree, each historian differs from two";
}

TEST(JudgeClocks, OneBetweenTwoSpeaksForNeither) {
  EXPECT_EQ(judged(1000, {500}), "open");
}

TEST(JudgeClocks, AnAcceptedDifferenceIsNoneWhileItLasts) {
  EXPECT_EQ(judged(5 * kHours, {}, {{"host h", 5 * kHours}}), "believed");
  EXPECT_EQ(judged(5 * kHours, {}, {{"host other", 5 * kHours}}), "open");
  EXPECT_EQ(judged(30 * 24 * kHours, {}, {{"host h", 5 * kHours}}), "open") << "another difference";
  EXPECT_EQ(judged(5 * kHours, {5 * kHours}, {{"historian 0", 5 * kHours}}), "believed, host");
  EXPECT_EQ(judged(0, {5 * kHours}, {{"historian 0", 5 * kHours - 60}}), "believed");
  EXPECT_EQ(judged(0, {}, {{"host h", 5 * kHours}}), "believed")
      << "set right since: what was accepted is of no more use";
}

TEST(JudgeClocks, DifferencesAreToldInTwoUnits) {
  EXPECT_EQ(difference_text(720), "12 min ahead");
  EXPECT_EQ(difference_text(-3), "the same time");
  EXPECT_EQ(difference_text(-5 * kHours - 120), "5 h 2 min behind");
  EXPECT_EQ(difference_text(30 * 24 * kHours), "30 d 0 h ahead");
}

}  // namespace
}  // namespace loopscope::daemon
