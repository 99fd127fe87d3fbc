#include "core/model/selection/stepwise_model.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <tuple>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/fit/baseline.hpp"
#include "core/model/residual_tests/nominations.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

StepwiseModel story_of(std::string_view scenario, std::uint64_t seed) {
  const simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, seed);
  const ModelInput input{record.pv, record.op, {}, {}, record.sample_interval_s};
  StepwiseModel story =
      start_selection(make_loop_data(record.pv, record.op, record.sample_interval_s));
  const ResidualTests tests = [&](const LoopData& data, const Fit& fit) {
    return run_residual_tests(input, data, fit);
  };
  std::ignore = select_effects(story, tests(story.data, story.baseline.fit), tests);
  return story;
}

TEST(StepwiseModel, BeginsWithTheLinearLoop) {
  const simulate::LoopRecord record = simulate::simulate_scenario("sticking_valve", {}, 1);
  const StepwiseModel story = start_selection(make_loop_data(record.pv, record.op, 1.0));
  EXPECT_TRUE(story.chapters.empty());
  EXPECT_TRUE(story.baseline.fit.structure.effects.empty());
  EXPECT_EQ(&story.last(), &story.baseline);
}

TEST(StepwiseModel, EveryChapterAddsOneEffectAndIsSignificant) {
  for (const char* scenario :
       {"load_upsets", "sticking_valve", "outside_oscillation", "worn_valve"}) {
    const StepwiseModel story = story_of(scenario, 3);
    ASSERT_FALSE(story.chapters.empty()) << scenario;
    for (std::size_t i = 0; i < story.chapters.size(); ++i) {
      EXPECT_EQ(story.chapters[i].fit.fit.structure.effects.size(), i + 1) << scenario;
      EXPECT_LE(story.chapters[i].comparison.p, 1e-3) << scenario;
      EXPECT_LE(story.chapters[i].rival_evidence, story.chapters[i].comparison.evidence)
          << scenario;
    }
  }
}

/// Of what no test asks for only waves and changes of gain are looked at.
TEST(StepwiseModel, WhatNoTestAsksForIsNotTried) {
  const simulate::LoopRecord record = simulate::simulate_scenario("sticking_valve", {}, 1);
  StepwiseModel story = start_selection(make_loop_data(record.pv, record.op, 1.0));
  std::ignore = select_effects(
      story, {}, [](const LoopData&, const Fit&) { return std::vector<TestOutcome>(); });
  for (const SelectedEffect& chapter : story.chapters) {
    const EffectKind kind = chapter.fit.fit.structure.effects.back()->kind();
    EXPECT_TRUE(kind == EffectKind::external_oscillation || kind == EffectKind::gain_change);
  }
}

TEST(StepwiseModel, AChapterKeepsWhoAskedForItAndWhatIsSaidAfterIt) {
  const StepwiseModel story = story_of("sticking_valve", 1);
  ASSERT_FALSE(story.chapters.empty());
  const SelectedEffect& chapter = story.chapters.front();
  EXPECT_EQ(chapter.promise_rank, 1U);
  const auto asked = asked_by(EffectKind::valve_deadband, chapter.asked_for, chapter.left);
  ASSERT_FALSE(asked.empty());
  EXPECT_EQ(asked.front().test, "op_direction");
  EXPECT_LE(asked.front().p, kNominates);
  EXPECT_GT(asked.front().p_after.value_or(0.0), kNominates);
}

/// However well it fits: the tests that asked for it have to see less of it.
TEST(StepwiseModel, AnEffectThatLeavesItsTestsAsTheyWereDoesNotEnter) {
  const simulate::LoopRecord record = simulate::simulate_scenario("worn_valve", {}, 1);
  const ModelInput input{record.pv, record.op, {}, {}, record.sample_interval_s};
  StepwiseModel story =
      start_selection(make_loop_data(record.pv, record.op, record.sample_interval_s));
  const std::vector<TestOutcome> first = run_residual_tests(input, story.data, story.baseline.fit);
  std::ignore = select_effects(story, first, [&](const LoopData&, const Fit&) { return first; });
  for (const SelectedEffect& chapter : story.chapters) {
    const EffectKind kind = chapter.fit.fit.structure.effects.back()->kind();
    const bool outside = same_cause(kind, EffectKind::load_step);
    EXPECT_TRUE(outside || chapter.comparison.evidence > 400.0) << name(kind);
  }
}

bool sits_where_it_was_fitted(EffectKind kind) {
  return kind == EffectKind::load_step;
}

/// Evidence of the first effect over the same process and noise without it, fitted anew.
double own_evidence(const StepwiseModel& story) {
  const CrossFit& with = story.chapters.front().fit;
  Structure structure = with.fit.structure;
  const EffectKind kind = structure.effects.back()->kind();
  structure.effects.clear();
  const CrossFit without = cross_fit(story.data, polish(story.data, structure, 20));
  const CrossFit again{evaluate(story.data, with.fit.structure),
                       evaluate(on_other_fold(story.data), with.other_fold.structure)};
  return compare(story.data, without, again, sits_where_it_was_fitted(kind)).evidence;
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
    StepwiseModel story = story_of(scenario, seed);
    if (story.chapters.empty()) continue;
    story.chapters.resize(1);
    EXPECT_GT(own_evidence(story), 13.8)
        << scenario << " " << seed << ", said to be " << story.chapters[0].comparison.evidence;
  }
}

}  // namespace
}  // namespace loopscope::core::model
