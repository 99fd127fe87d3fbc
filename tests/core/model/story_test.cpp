#include "core/model/story.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "core/model/baseline.hpp"
#include "core/model/effects/valve.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

std::vector<Answer> suspicious_of_the_valve() {
  Answer answer;
  answer.question = {"op_direction", 0.01, {}};
  return {answer};
}

Story story_of(std::string_view scenario, std::uint64_t seed) {
  const simulate::LoopRecord record = simulate::simulate_scenario(scenario, {}, seed);
  Story story = begin_story(make_loop_data(record.pv, record.op, record.sample_interval_s));
  continue_story(story, suspicious_of_the_valve());
  return story;
}

TEST(Story, BeginsWithTheLinearLoop) {
  const simulate::LoopRecord record = simulate::simulate_scenario("sticking_valve", {}, 1);
  const Story story = begin_story(make_loop_data(record.pv, record.op, 1.0));
  EXPECT_TRUE(story.chapters.empty());
  EXPECT_TRUE(story.baseline.fit.structure.effects.empty());
  EXPECT_EQ(&story.last(), &story.baseline);
}

TEST(Story, EveryChapterAddsOneEffectAndIsSignificant) {
  for (const char* scenario :
       {"load_upsets", "sticking_valve", "outside_oscillation", "worn_valve"}) {
    const Story story = story_of(scenario, 3);
    ASSERT_FALSE(story.chapters.empty()) << scenario;
    for (std::size_t i = 0; i < story.chapters.size(); ++i) {
      EXPECT_EQ(story.chapters[i].fit.fit.structure.effects.size(), i + 1) << scenario;
      EXPECT_LE(story.chapters[i].comparison.p, 1e-3) << scenario;
      EXPECT_LE(story.chapters[i].rival_evidence, story.chapters[i].comparison.evidence)
          << scenario;
    }
  }
}

/// To follow a valve by pv costs most: only an answer that calls for it starts that search.
TEST(Story, WithoutSuspicionNoValveIsPutRight) {
  const simulate::LoopRecord record = simulate::simulate_scenario("sticking_valve", {}, 1);
  Story story = begin_story(make_loop_data(record.pv, record.op, 1.0));
  continue_story(story, {});
  for (const Chapter& chapter : story.chapters) {
    for (const EffectPtr& effect : chapter.fit.fit.structure.effects) {
      const auto* valve = dynamic_cast<const ValveEffect*>(effect.get());
      EXPECT_TRUE(valve == nullptr || valve->by_law_alone());
    }
  }
}

bool sits_where_it_was_fitted(EffectKind kind) {
  return kind == EffectKind::load_step || kind == EffectKind::valve_stiction ||
         kind == EffectKind::valve_deadband;
}

/// Evidence of the first effect over the same process and noise without it, fitted anew.
double own_evidence(const Story& story) {
  const TwinFit& with = story.chapters.front().fit;
  Structure structure = with.fit.structure;
  const EffectKind kind = structure.effects.back()->kind();
  structure.effects.clear();
  const TwinFit without = twin(story.data, polish(story.data, structure, 20));
  const TwinFit again{evaluate(story.data, with.fit.structure),
                      evaluate(mirrored(story.data), with.mirror.structure)};
  return compare(story.data, without, again, sits_where_it_was_fitted(kind)).evidence;
}

/// An effect is fitted with a search of process and noise, which may leave a poor baseline by
/// itself: what that gains is not the effect's. p = 0.001 is an evidence of 13.8.
TEST(Story, TheEvidenceIsTheEffectsOwn) {
  for (const auto& [scenario, seed] : {std::pair{"outside_oscillation", 1U},
                                       {"paper_5_3", 1U},
                                       {"sticking_valve", 1U},
                                       {"level_loop", 3U},
                                       {"level_loop", 102U},
                                       {"level_loop", 117U}}) {
    Story story = story_of(scenario, seed);
    if (story.chapters.empty()) continue;
    story.chapters.resize(1);
    EXPECT_GT(own_evidence(story), 13.8)
        << scenario << " " << seed << ", said to be " << story.chapters[0].comparison.evidence;
  }
}

}  // namespace
}  // namespace loopscope::core::model
