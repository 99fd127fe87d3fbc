#include "core/model/intake.hpp"

#include <gtest/gtest.h>
#include <span>

#include "core/model/contest.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/everything_asked.hpp"

namespace loopscope::core::model {
namespace {

/// Curved valve or curved process: both fit, and the test that asked for the better one says that
/// nothing has changed.
class IntakeOfTrials : public testing::Test {
 protected:
  void SetUp() override {
    const Asked asked = tests::everything_asked();
    trials_ =
        hold_contest({story_.data, story_.data, story_.last(), asked, false, Reach::asked}).trials;
    ASSERT_GE(trials_.size(), 2U);
    ASSERT_TRUE(trials_[1].enters());
    leader_ = trials_.front().kind();
    said_ = {{{"a test", 1e-30, "saw something"}, {{.effect = leader_, .p = 1e-30}}}};
  }
  bool take(std::optional<EffectKind> outdone_by, double passed_over = 0.0) {
    const ResidualTests tests = [&](const LoopData&, const Fit&) { return said_; };
    return take_in(trials_, {original_, tests, said_, outdone_by, passed_over}, story_);
  }

  const simulate::LoopRecord record_ = simulate::simulate_scenario("worn_valve", {}, 1);
  const LoopData original_ = make_loop_data(record_.pv, record_.op, record_.sample_interval_s);
  Story story_ = begin_story(original_);
  std::vector<Contestant> trials_;
  EffectKind leader_ = EffectKind::load_step;
  std::vector<Answer> said_;
};

TEST_F(IntakeOfTrials, BehindARefusedTrialTheNextOneEnters) {
  EXPECT_TRUE(take(std::nullopt));
  ASSERT_EQ(story_.chapters.size(), 1U);
  EXPECT_NE(story_.chapters.front().kind(), leader_);
}

TEST_F(IntakeOfTrials, ButNotWhereTheRefusedOneLetOthersBePassedOver) {
  EXPECT_FALSE(take(leader_));
  EXPECT_TRUE(story_.chapters.empty());
}

TEST_F(IntakeOfTrials, WhatWasPassedOverIsARivalByItsPromise) {
  const double promise = trials_[1].comparison.evidence;
  ASSERT_TRUE(take(std::nullopt, promise));
  EXPECT_GE(story_.chapters.front().rival_evidence, promise);
}

}  // namespace
}  // namespace loopscope::core::model
