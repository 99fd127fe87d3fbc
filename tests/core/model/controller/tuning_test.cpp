#include "core/model/controller/tuning.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "core/model/controller/simc.hpp"
#include "tests/core/model/known_loops.hpp"
#include "tests/core/model/tuning_cases.hpp"

namespace loopscope::core::model {
namespace {

using known::TuningRates;

Tuning judged(const char* name, std::uint64_t seed) {
  const known::KnownLoop loop = known::scenario(name);
  return judge_tuning(known::off_by_a_fifth(loop.process, seed), loop.law, 1.0).tuning;
}

TEST(Tuning, PlantLoopsWithFitsOffByAFifth) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    EXPECT_EQ(judged("healthy_flow", seed), Tuning::fine);
    EXPECT_EQ(judged("paper_5_2_printed", seed), Tuning::fine);
    EXPECT_EQ(judged("level_loop", seed), Tuning::fine);
    EXPECT_EQ(judged("deadband", seed), Tuning::fine);
    EXPECT_EQ(judged("tight_tuning", seed), Tuning::tight);
    EXPECT_EQ(judged("paper_5_2_excessive", seed), Tuning::tight);
    EXPECT_EQ(judged("sluggish_tuning", seed), Tuning::sluggish);
  }
}

TEST(Tuning, RandomLoopsWithFitsOffByAFifth) {
  const TuningRates rates = known::tuning_rates(1000);
  EXPECT_GE(rates.tight.share(Tuning::tight), 0.95);
  EXPECT_GE(rates.sluggish.share(Tuning::sluggish), 0.95);
  EXPECT_GE(rates.fine.share(Tuning::fine), 0.97);
}

TEST(Tuning, SimcItselfIsFineAndItsOwnReference) {
  const ProcessFit fit{false, 2.0, 30.0, 8.0, 5.0};
  const TuningJudgement judgement = judge_tuning(fit, simc_law(fit, 1.0), 1.0);
  EXPECT_EQ(judgement.tuning, Tuning::fine);
  EXPECT_DOUBLE_EQ(judgement.slowness, 1.0);
  EXPECT_DOUBLE_EQ(judgement.settling_ratio, 1.0);
}

TEST(Tuning, HopelesslyUnstableContradicts) {
  const known::KnownLoop loop = known::scenario("healthy_flow");
  EXPECT_EQ(judge_tuning(loop.process, known::law(3.0, 3.0), 1.0).tuning, Tuning::contradictory);
  EXPECT_EQ(judge_tuning(loop.process, known::law(-0.2, -0.1), 1.0).tuning, Tuning::contradictory);
}

TEST(Tuning, GainAloneIsNeverSluggish) {
  const known::KnownLoop loop = known::scenario("level_loop");
  const TuningJudgement judgement = judge_tuning(loop.process, known::law(0.5, 0.0), 1.0);
  EXPECT_EQ(judgement.tuning, Tuning::fine);
  EXPECT_EQ(judgement.slowness, 0.0);
}

}  // namespace
}  // namespace loopscope::core::model
