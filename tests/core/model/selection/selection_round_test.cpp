#include "core/model/selection/selection_round.hpp"

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
  StepwiseModel stepwise = start_selection(linear_loop());
};

TEST_F(Candidates, WhatPromisesMostIsFirst) {
  const std::vector<Nomination> nominations = {
      {.effect = EffectKind::valve_deadband, .p = 1e-20},
      {.effect = EffectKind::process_nonlinearity, .p = 1e-30}};
  const Nominations asked{std::span<const Nomination>(nominations)};
  const Round round{stepwise.data, stepwise.data, stepwise.last(), asked};
  const CandidateSearch found(round);
  ASSERT_EQ(found.kinds().size(), 2U);
  EXPECT_EQ(found.kinds()[0].kind, EffectKind::process_nonlinearity);
  EXPECT_EQ(found.kinds()[1].kind, EffectKind::valve_stiction);
  EXPECT_EQ(found.kinds()[1].promise, asked.promise(EffectKind::valve_stiction));
}

TEST_F(Candidates, UnaskedKindsAreThoseThatNobodyAskedFor) {
  const Nominations everything = tests::everything_asked();  // but waves
  const Round round{stepwise.data, stepwise.data, stepwise.last(),
                    everything,    false,         Reach::unasked};
  const CandidateSearch found(round);
  ASSERT_EQ(found.kinds().size(), 1U);
  EXPECT_EQ(found.kinds().front().kind, EffectKind::external_oscillation);
}

TEST_F(Candidates, WhatHasNoPlaceToStartFromIsNotTried) {
  const std::vector<Nomination> held = {{.effect = EffectKind::sensor_hold, .p = 1e-30}};
  const Nominations asked{std::span<const Nomination>(held)};
  const Round round{stepwise.data, stepwise.data, stepwise.last(), asked};
  EXPECT_TRUE(CandidateSearch(round).kinds().empty());
}

TEST_F(Candidates, AfterALoadStepNothingElseIsLookedAt) {
  const Nominations everything = tests::everything_asked();
  const Round round{stepwise.data, stepwise.data, stepwise.last(), everything, true};
  const CandidateSearch found(round);
  ASSERT_EQ(found.kinds().size(), 1U);
  EXPECT_EQ(found.kinds().front().kind, EffectKind::load_step);
}

constexpr std::size_t kContestSamples = 2000;
constexpr std::size_t kAt = 1100;
const ProcessShape kShape = tests::one_lag(0.8, 3);

/// What enters the process from kAt on, in % of op; a level and a part of the flow.
LoopData changed(double level, double part, std::uint64_t seed) {
  const tests::Series op = tests::stepping_op(kContestSamples, seed);
  tests::Series more(kContestSamples, 0.0);
  for (std::size_t k = kAt; k < kContestSamples; ++k) more[k] = level + part * (op[k] - 50.0);
  const tests::Series noise = tests::coloured_noise(tests::kNoise, kContestSamples, seed + 50, 1.0);
  const tests::Series rest = tests::sum(tests::scaled(answer(kShape, more), 1.5), noise);
  return make_loop_data(tests::process_record(kShape, 1.5, op, rest), op, 1.0);
}

SelectionOutcome first_contest(const LoopData& data, Reach reach = Reach::promising) {
  const StepwiseModel stepwise = start_selection(data);
  const Nominations asked = tests::everything_asked();
  return run_selection_round({stepwise.data, stepwise.data, stepwise.last(), asked, false, reach});
}

bool among(const std::vector<CandidateFit>& entries, EffectKind kind) {
  return std::ranges::any_of(
      entries, [&](const CandidateFit& entry) { return entry.enters() && entry.kind() == kind; });
}

TEST(SelectionOutcome, ALoadThatMovesIsNoChangeOfGain) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto entries = first_contest(changed(12.0, 0.0, seed)).trials;
    EXPECT_TRUE(among(entries, EffectKind::load_step)) << seed;
    EXPECT_FALSE(among(entries, EffectKind::gain_change)) << seed;
  }
}

TEST(SelectionOutcome, AChangeOfGainTakesItsLevelWithIt) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto entries = first_contest(changed(12.0, 0.6, seed)).trials;
    ASSERT_FALSE(entries.empty());
    EXPECT_EQ(entries.front().kind(), EffectKind::gain_change) << seed;
    EXPECT_TRUE(entries.front().enters()) << seed;
  }
}

TEST(SelectionOutcome, WhatAnEarlierTrialOutdoesIsPassedOver) {
  const LoopData data = changed(40.0, 0.0, 1);
  const SelectionOutcome promising = first_contest(data), all = first_contest(data, Reach::asked);
  EXPECT_EQ(promising.outdone_by, EffectKind::load_step);
  EXPECT_GT(promising.passed_over, 0.0);
  EXPECT_FALSE(all.outdone_by);
  ASSERT_FALSE(promising.trials.empty());
  EXPECT_LT(promising.trials.size(), all.trials.size());
  EXPECT_EQ(promising.trials.front().kind(), all.trials.front().kind());
  EXPECT_EQ(promising.trials.front().worth(), all.trials.front().worth());
}

TEST(SelectionOutcome, WithoutThatMechanismEverythingIsTried) {
  LoopData data = changed(40.0, 0.0, 1);
  data.without.leave_out(Mechanism::outdone_skipped);
  EXPECT_FALSE(first_contest(data).outdone_by);
}

}  // namespace
}  // namespace loopscope::core::model
