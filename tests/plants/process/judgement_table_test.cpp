#include "tests/plants/process/judgement_table.hpp"

#include <gtest/gtest.h>

namespace loopscope::tests::process {
namespace {

Judgement judged(double odds, bool right) {
  Judgement one;
  one.cause = Cause::tight_loop;
  one.found = true;
  one.first_odds = odds;
  one.first_right = right;
  return one;
}

TEST(JudgementTable, OddsThatHoldHaveNoError) {
  std::vector<Judgement> judgements;
  for (int k = 0; k < 10; ++k) judgements.push_back(judged(0.7, k < 7));
  EXPECT_NEAR(calibration_error(judgements), 0.0, 1e-12);
  judgements.push_back({});  // no event, no odds
  EXPECT_NEAR(calibration_error(judgements), 0.0, 1e-12);
  for (Judgement& one : judgements) one.first_right = one.found;
  EXPECT_NEAR(calibration_error(judgements), 0.3, 1e-12);
  EXPECT_EQ(calibration_error({}), 0.0);
}

TEST(JudgementTable, CountsByCause) {
  std::vector<Judgement> judgements{judged(0.9, true), judged(0.9, true), {}};
  judgements[0].source_first = true;
  const std::string text = table_of(judgements);
  EXPECT_NE(text.find("tight_loop            2"), std::string::npos) << text;
  EXPECT_NE(text.find("none                  1"), std::string::npos) << text;
  EXPECT_NE(text.find("source first 0.500"), std::string::npos) << text;
}

TEST(JudgedPlant, ATightLoopShakesItsPlantAndACalmOneShowsNothing) {
  const Judgement tight = judge_plant(PlantKind::four_tanks, Cause::tight_loop, 3);
  EXPECT_TRUE(tight.found);
  EXPECT_GE(2 * tight.carriers_found, tight.carriers);
  EXPECT_EQ(judge_plant(PlantKind::four_tanks, Cause::none, 3).events, 0U);
}

}  // namespace
}  // namespace loopscope::tests::process
