#include "core/model/selection/stepwise_model.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <span>
#include <tuple>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit/baseline.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/model/selection/selection_round.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/everything_asked.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

StepwiseModel model_of(std::string_view scenario, std::uint64_t seed) {
  const simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, seed);
  const ModelInput input{record.pv, record.op, {}, {}, record.sample_interval_s};
  StepwiseModel stepwise =
      start_selection(make_loop_data(record.pv, record.op, record.sample_interval_s));
  const ResidualTests tests = [&](const LoopData& data, const Fit& fit) {
    return run_residual_tests(input, data, fit);
  };
  std::ignore = select_effects(stepwise, tests(stepwise.data, stepwise.baseline.fit), tests);
  return stepwise;
}

TEST(StepwiseModel, BeginsWithTheLinearLoop) {
  const simulate::LoopRecord record = simulate::simulate_scenario("sticking_valve", {}, 1);
  const StepwiseModel stepwise = start_selection(make_loop_data(record.pv, record.op, 1.0));
  EXPECT_TRUE(stepwise.selected.empty());
  EXPECT_TRUE(stepwise.baseline.fit.structure.effects.empty());
  EXPECT_EQ(&stepwise.last(), &stepwise.baseline);
}

TEST(StepwiseModel, EveryChapterAddsOneEffectAndIsSignificant) {
  for (const char* scenario :
       {"load_upsets", "sticking_valve", "outside_oscillation", "worn_valve"}) {
    const StepwiseModel stepwise = model_of(scenario, 3);
    ASSERT_FALSE(stepwise.selected.empty()) << scenario;
    for (std::size_t i = 0; i < stepwise.selected.size(); ++i) {
      EXPECT_EQ(stepwise.selected[i].fit.fit.structure.effects.size(), i + 1) << scenario;
      EXPECT_LE(stepwise.selected[i].comparison.p, 1e-3) << scenario;
      EXPECT_LE(stepwise.selected[i].rival_evidence, stepwise.selected[i].comparison.evidence)
          << scenario;
    }
  }
}

/// Of what no test asks for only waves and changes of gain are looked at.
TEST(StepwiseModel, WhatNoTestAsksForIsNotTried) {
  const simulate::LoopRecord record = simulate::simulate_scenario("sticking_valve", {}, 1);
  StepwiseModel stepwise = start_selection(make_loop_data(record.pv, record.op, 1.0));
  std::ignore = select_effects(
      stepwise, {}, [](const LoopData&, const Fit&) { return std::vector<TestOutcome>(); });
  for (const SelectedEffect& entered : stepwise.selected) {
    const EffectKind kind = entered.fit.fit.structure.effects.back()->kind();
    EXPECT_TRUE(kind == EffectKind::external_oscillation || kind == EffectKind::gain_change);
  }
}

TEST(StepwiseModel, AChapterKeepsWhoAskedForItAndWhatIsSaidAfterIt) {
  const StepwiseModel stepwise = model_of("sticking_valve", 1);
  ASSERT_FALSE(stepwise.selected.empty());
  const SelectedEffect& entered = stepwise.selected.front();
  EXPECT_EQ(entered.promise_rank, 1U);
  const auto asked = asked_by(EffectKind::valve_deadband, entered.asked_for, entered.left);
  ASSERT_FALSE(asked.empty());
  EXPECT_EQ(asked.front().test, "op_direction");
  EXPECT_LE(asked.front().p, kNominates);
  EXPECT_GT(asked.front().p_after.value_or(0.0), kNominates);
}

/// However well it fits: the tests that asked for it have to see less of it.
TEST(StepwiseModel, AnEffectThatLeavesItsTestsAsTheyWereDoesNotEnter) {
  const simulate::LoopRecord record = simulate::simulate_scenario("worn_valve", {}, 1);
  const ModelInput input{record.pv, record.op, {}, {}, record.sample_interval_s};
  StepwiseModel stepwise =
      start_selection(make_loop_data(record.pv, record.op, record.sample_interval_s));
  const std::vector<TestOutcome> first =
      run_residual_tests(input, stepwise.data, stepwise.baseline.fit);
  std::ignore = select_effects(stepwise, first, [&](const LoopData&, const Fit&) { return first; });
  for (const SelectedEffect& entered : stepwise.selected) {
    const EffectKind kind = entered.fit.fit.structure.effects.back()->kind();
    const bool outside = same_cause(kind, EffectKind::load_step);
    EXPECT_TRUE(outside || entered.comparison.evidence > 400.0) << name(kind);
  }
}

bool sits_where_it_was_fitted(EffectKind kind) {
  return kind == EffectKind::load_step;
}

/// Evidence of the first effect over the same process and noise without it, fitted anew.
double own_evidence(const StepwiseModel& stepwise) {
  const CrossFit& with = stepwise.selected.front().fit;
  Structure structure = with.fit.structure;
  const EffectKind kind = structure.effects.back()->kind();
  structure.effects.clear();
  const CrossFit without = cross_fit(stepwise.data, polish(stepwise.data, structure, 20));
  const CrossFit again{evaluate(stepwise.data, with.fit.structure),
                       evaluate(on_other_fold(stepwise.data), with.other_fold.structure)};
  return compare(stepwise.data, without, again, sits_where_it_was_fitted(kind)).evidence;
}

/// An effect is fitted with a search of process and noise, which may leave a poor baseline by
/// itself: what that gains is not the effect's. p = 0.001 is an evidence of 13.8.
TEST(StepwiseModel, TheEvidenceIsTheEffectsOwn) {
  for (const auto& [scenario, seed] : {std::pair{"outside_oscillation", 1U},
                                       {"paper_5_3", 1U},
                                       {"sticking_valve", 1U},
                                       {"level_loop", 3U},
                                       {"level_loop", 102U},
                                       {"level_loop", 117U}}) {
    StepwiseModel stepwise = model_of(scenario, seed);
    if (stepwise.selected.empty()) continue;
    stepwise.selected.resize(1);
    EXPECT_GT(own_evidence(stepwise), 13.8)
        << scenario << " " << seed << ", said to be " << stepwise.selected[0].comparison.evidence;
  }
}

using loopscope::tests::kWindow;

/// A valve that sticks, S 4 and J 2.5 % of op, behind which play was found.
CandidateFit play_for_sticking(std::uint64_t seed) {
  const tests::Series op =
      tests::sum(tests::stepping_op(kWindow, seed, 3.0),
                 tests::coloured_noise({1, {0.95, 0, 0}, {}}, kWindow, seed + 100, 0.5));
  tests::Series mv(kWindow);
  run_valve({ValveLaw::he, 4.0, 2.5, 1.0, {0.2, 0.0, 0.0}}, op, mv);
  const tests::Series pv = tests::process_record(tests::one_lag(0.8, 3), 1.5, mv,
                                                 tests::white_noise(kWindow, seed + 200, 0.3));
  const LoopData data = make_loop_data(pv, op, 1.0);
  Fit linear = search_process(data, {});
  Structure play = linear.structure;
  play.effects = {std::make_shared<ValveEffect>(Valve{ValveLaw::he, 4.4, 0.0, 1.0})};
  return scored({{}, {}, data, cross_fit(data, std::move(linear)), 0.0}, search_process(data, play),
                10);
}

TEST(CloserLook, FindsWhatSticksBehindPlay) {
  const CandidateFit entered = play_for_sticking(1);
  ASSERT_EQ(entered.kind(), EffectKind::valve_deadband);
  const std::optional<CandidateFit> closer = refine_valve(entered, entered.fit.fit, 1);
  ASSERT_TRUE(closer);
  EXPECT_EQ(closer->kind(), EffectKind::valve_stiction);
  EXPECT_GT(closer->worth(), entered.worth());
  EXPECT_GT(closer->price, entered.price) << "it was chosen from more guesses";
}

TEST(CloserLook, FindsNothingWhereTheSearchIsLeftOut) {
  CandidateFit entered = play_for_sticking(1);
  entered.rows.without.leave_out(Mechanism::stem_search);
  EXPECT_FALSE(refine_valve(entered, entered.fit.fit, 1));
}

/// Curved valve or curved process: both fit, and the test that asked for the better one says that
/// nothing has changed.
class IntakeOfTrials : public testing::Test {
 protected:
  void SetUp() override {
    const Nominations asked = tests::everything_asked();
    trials = run_selection_round(
                 {stepwise.data, stepwise.data, stepwise.last(), asked, false, Reach::asked})
                 .trials;
    ASSERT_GE(trials.size(), 2U);
    ASSERT_TRUE(trials[1].enters());
    leader = trials.front().kind();
    said = {{{"a test", 1e-30, "saw something"}, {{.effect = leader, .p = 1e-30}}}};
  }
  bool take(std::optional<EffectKind> outdone_by, double passed_over = 0.0) {
    const ResidualTests tests = [&](const LoopData&, const Fit&) { return said; };
    return take_in(trials, {original, tests, said, outdone_by, passed_over}, stepwise);
  }

  const simulate::LoopRecord record = simulate::simulate_scenario("worn_valve", {}, 1);
  const LoopData original = make_loop_data(record.pv, record.op, record.sample_interval_s);
  StepwiseModel stepwise = start_selection(original);
  std::vector<CandidateFit> trials;
  EffectKind leader = EffectKind::load_step;
  std::vector<TestOutcome> said;
};

TEST_F(IntakeOfTrials, BehindARefusedTrialTheNextOneEnters) {
  EXPECT_TRUE(take(std::nullopt));
  ASSERT_EQ(stepwise.selected.size(), 1U);
  EXPECT_NE(stepwise.selected.front().kind(), leader);
}

TEST_F(IntakeOfTrials, ButNotWhereTheRefusedOneLetOthersBePassedOver) {
  EXPECT_FALSE(take(leader));
  EXPECT_TRUE(stepwise.selected.empty());
}

TEST_F(IntakeOfTrials, WhatWasPassedOverIsARivalByItsPromise) {
  const double promise = trials[1].comparison.evidence;
  ASSERT_TRUE(take(std::nullopt, promise));
  EXPECT_GE(stepwise.selected.front().rival_evidence, promise);
}

}  // namespace
}  // namespace loopscope::core::model
