#include "core/model/selection/candidates.hpp"

#include <gtest/gtest.h>

#include "core/model/selection/stepwise_model.hpp"
#include "tests/core/model/everything_asked.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kSearchSamples = 2000;
const ProcessShape kSearchShape = tests::one_lag(0.8, 3);

LoopData linear_loop() {
  const tests::Series op = tests::stepping_op(kSearchSamples, 1);
  const tests::Series noise = tests::coloured_noise(tests::kNoise, kSearchSamples, 51, 1.0);
  return make_loop_data(tests::process_record(kSearchShape, 1.5, op, noise), op, 1.0);
}

class Candidates : public testing::Test {
 protected:
  StepwiseModel story = start_selection(linear_loop());
};

TEST_F(Candidates, WhatPromisesMostIsFirst) {
  const std::vector<Nomination> nominations = {
      {.effect = EffectKind::valve_deadband, .p = 1e-20},
      {.effect = EffectKind::process_nonlinearity, .p = 1e-30}};
  const Nominations asked{std::span<const Nomination>(nominations)};
  const Round round{story.data, story.data, story.last(), asked};
  const CandidateSearch found(round);
  ASSERT_EQ(found.kinds().size(), 2U);
  EXPECT_EQ(found.kinds()[0].kind, EffectKind::process_nonlinearity);
  EXPECT_EQ(found.kinds()[1].kind, EffectKind::valve_stiction);
  EXPECT_EQ(found.kinds()[1].promise, asked.promise(EffectKind::valve_stiction));
}

TEST_F(Candidates, UnaskedKindsAreThoseThatNobodyAskedFor) {
  const Nominations everything = tests::everything_asked();  // but waves
  const Round round{story.data, story.data, story.last(), everything, false, Reach::unasked};
  const CandidateSearch found(round);
  ASSERT_EQ(found.kinds().size(), 1U);
  EXPECT_EQ(found.kinds().front().kind, EffectKind::external_oscillation);
}

TEST_F(Candidates, WhatHasNoPlaceToStartFromIsNotTried) {
  const std::vector<Nomination> held = {{.effect = EffectKind::sensor_hold, .p = 1e-30}};
  const Nominations asked{std::span<const Nomination>(held)};
  const Round round{story.data, story.data, story.last(), asked};
  EXPECT_TRUE(CandidateSearch(round).kinds().empty());
}

TEST_F(Candidates, AfterALoadStepNothingElseIsLookedAt) {
  const Nominations everything = tests::everything_asked();
  const Round round{story.data, story.data, story.last(), everything, true};
  const CandidateSearch found(round);
  ASSERT_EQ(found.kinds().size(), 1U);
  EXPECT_EQ(found.kinds().front().kind, EffectKind::load_step);
}

}  // namespace
}  // namespace loopscope::core::model
