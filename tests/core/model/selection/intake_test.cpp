#include "core/model/selection/intake.hpp"

#include <gtest/gtest.h>
#include <span>

#include "core/model/selection/selection_round.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/everything_asked.hpp"

namespace loopscope::core::model {
namespace {

/// Curved valve or curved process: both fit, and the test that asked for the better one says that
/// nothing has changed.
class IntakeOfTrials : public testing::Test {
 protected:
  void SetUp() override {
    const Nominations asked = tests::everything_asked();
    trials = run_selection_round({story.data, story.data, story.last(), asked, false, Reach::asked})
                 .trials;
    ASSERT_GE(trials.size(), 2U);
    ASSERT_TRUE(trials[1].enters());
    leader = trials.front().kind();
    said = {{{"a test", 1e-30, "saw something"}, {{.effect = leader, .p = 1e-30}}}};
  }
  bool take(std::optional<EffectKind> outdone_by, double passed_over = 0.0) {
    const ResidualTests tests = [&](const LoopData&, const Fit&) { return said; };
    return take_in(trials, {original, tests, said, outdone_by, passed_over}, story);
  }

  const simulate::LoopRecord record = simulate::simulate_scenario("worn_valve", {}, 1);
  const LoopData original = make_loop_data(record.pv, record.op, record.sample_interval_s);
  StepwiseModel story = start_selection(original);
  std::vector<CandidateFit> trials;
  EffectKind leader = EffectKind::load_step;
  std::vector<TestOutcome> said;
};

TEST_F(IntakeOfTrials, BehindARefusedTrialTheNextOneEnters) {
  EXPECT_TRUE(take(std::nullopt));
  ASSERT_EQ(story.chapters.size(), 1U);
  EXPECT_NE(story.chapters.front().kind(), leader);
}

TEST_F(IntakeOfTrials, ButNotWhereTheRefusedOneLetOthersBePassedOver) {
  EXPECT_FALSE(take(leader));
  EXPECT_TRUE(story.chapters.empty());
}

TEST_F(IntakeOfTrials, WhatWasPassedOverIsARivalByItsPromise) {
  const double promise = trials[1].comparison.evidence;
  ASSERT_TRUE(take(std::nullopt, promise));
  EXPECT_GE(story.chapters.front().rival_evidence, promise);
}

}  // namespace
}  // namespace loopscope::core::model
