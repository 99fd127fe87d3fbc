#include "tests/effects/generator.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <span>
#include <sstream>

#include "tests/effects/draft.hpp"
#include "tests/effects/explainable.hpp"
#include "tests/support/chance.hpp"
#include "tests/support/long_run.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::tests::effects {
namespace {

TEST(Generator, GivesTheSameRecordForTheSameSeedOnly) {
  EXPECT_EQ(generate("valve_stiction", 3).pv, generate("valve_stiction", 3).pv);
  EXPECT_NE(generate("valve_stiction", 3).pv, generate("valve_stiction", 4).pv);
  EXPECT_NE(generate("healthy_still", 3).pv, generate("healthy_moving", 3).pv);
}

TEST(Generator, RefusesAnUnknownKind) {
  EXPECT_THROW((void)generate("valve_of_gold", 1), std::invalid_argument);
}

TEST(Generator, EveryKindIsWholeAndInsideItsLimits) {
  for (const KindInfo& kind : all_kinds()) {
    const Record record = generate(kind.name, 11);
    ASSERT_EQ(record.pv.size(), kSamples) << kind.name;
    ASSERT_EQ(record.sp.size(), kSamples) << kind.name;
    ASSERT_EQ(record.op.size(), kSamples) << kind.name;
    ASSERT_EQ(record.mv.size(), kSamples) << kind.name;
    EXPECT_TRUE(std::all_of(record.op.begin(), record.op.end(),
                            [](double op) { return op >= 0.0 && op <= 100.0; }));
    EXPECT_TRUE(std::all_of(record.pv.begin(), record.pv.end(),
                            [](double pv) { return std::isfinite(pv); }));
    EXPECT_GT(record.truth.floor, 0.0) << kind.name;
  }
}

TEST(Generator, TruthNamesTheEffectsOfTheKind) {
  for (const KindInfo& kind : all_kinds()) {
    std::set<std::string> named;
    for (const TrueEffect& effect : generate(kind.name, 5).truth.effects) {
      named.insert(effect.effect);
      EXPECT_FALSE(effect.parameters.empty()) << kind.name;
    }
    EXPECT_EQ(named, std::set<std::string>(kind.effects.begin(), kind.effects.end())) << kind.name;
  }
}

/// Innovations of the noise that really was drawn, of the renewed values alone, by the variance
/// that the Riccati equation gives. The first tenth is left to the filter.
double innovation_ratio(const Finished& finished) {
  const Scenario& scenario = finished.draft.scenario;
  return realised_floor(scenario, finished.series) / floor_of(scenario);
}

class FloorOf : public testing::TestWithParam<const char*> {};

TEST_P(FloorOf, IsTheMeasuredVarianceOfTheInnovations) {
  constexpr std::size_t kSeeds = 40;
  const std::size_t seeds = records(kSeeds);
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
    sum += innovation_ratio(finish(GetParam(), seed));
  EXPECT_NEAR(sum / static_cast<double>(seeds), 1.0, widened(0.03, kSeeds, seeds));
}

INSTANTIATE_TEST_SUITE_P(Kinds, FloorOf,
                         testing::Values("healthy_still", "tight", "process_nonlinearity",
                                         "sensor_hold", "sensor_quantisation"),
                         [](const auto& kind) { return std::string(kind.param); });

TEST(Generator, StickingStemLagsByItsStaticFriction) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Record record = generate("valve_stiction", seed);
    const TrueEffect& effect = record.truth.effects.front();
    std::vector<double> behind;
    for (std::size_t k = 0; k < kSamples; ++k)
      behind.push_back(std::abs(record.op[k] - record.mv[k]));
    std::sort(behind.begin(), behind.end());
    const double reach = behind[kSamples * 98 / 100];
    // Static friction is (S + J) / 2; a slow stem and a step of the set point go beyond it.
    const double friction = (effect.parameters[0].value + effect.parameters[1].value) / 2.0;
    EXPECT_GT(reach, 0.75 * friction) << seed;
    EXPECT_LT(reach, 1.15 * friction) << seed;
  }
}

TEST(Generator, AQuantisedSensorReportsWholeSteps) {
  const Record record = generate("sensor_quantisation", 2);
  const double step = record.truth.effects.front().parameters.front().value;
  for (std::size_t k = 1; k < kSamples; ++k) {
    const double steps = (record.pv[k] - record.pv[k - 1]) / step;
    ASSERT_NEAR(steps, std::round(steps), 1e-6);
  }
}

TEST(Generator, AHeldSensorRenewsItsValueAsOftenAsItSays) {
  const Record record = generate("sensor_hold", 2);
  const double samples = record.truth.effects.front().parameters.front().value;
  int changes = 0;
  for (std::size_t k = 1; k < kSamples; ++k) changes += record.pv[k] != record.pv[k - 1] ? 1 : 0;
  EXPECT_NEAR(changes, static_cast<double>(kSamples) / samples, 1.5);
}

TEST(Generator, AnEffectBeginsFromOneSampleToTheNext) {
  const Record record = generate_onset("sensor_hold", 2, kSamples, kSamples);
  const double samples = record.truth.effects.front().parameters.front().value;
  ASSERT_EQ(record.pv.size(), 2 * kSamples);
  std::size_t before = 0, behind = 0;
  for (std::size_t k = 1; k < record.pv.size(); ++k)
    (k < kSamples ? before : behind) += record.pv[k] != record.pv[k - 1] ? 1U : 0U;
  EXPECT_EQ(before, kSamples - 1);
  EXPECT_NEAR(static_cast<double>(behind), static_cast<double>(kSamples) / samples, 1.5);
}

TEST(Generator, AnOnsetOfNothingIsNoOnset) {
  const Scenario loop = finish("healthy_moving", 1).draft.scenario;
  const Series whole = simulate(loop), parts = simulate_onset(loop, loop, 1500);
  EXPECT_EQ(parts.pv, whole.pv);
  EXPECT_EQ(parts.op, whole.op);
}

TEST(Generator, ALoopIsItselfUntilTheOnsetAndItsValveHasFollowedByThen) {
  constexpr std::size_t kBefore = 1500;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Finished finished = finish("valve_stiction", seed);
    Scenario calm = finished.draft.base;
    calm.sp = finished.draft.scenario.sp;
    const Series without = simulate(calm);
    const Series with = simulate_onset(calm, finished.draft.scenario, kBefore);
    const auto is_same = [&](std::size_t k) { return with.mv[k] == without.mv[k]; };
    for (std::size_t k = 0; k < kBefore; ++k) ASSERT_TRUE(is_same(k)) << seed << " at " << k;
    EXPECT_FALSE(is_same(kBefore)) << seed;
    const std::vector<TrueParameter>& of = finished.draft.effects.front().parameters;
    const double friction = (of[0].value + of[1].value) / 2.0;
    EXPECT_LT(std::abs(with.mv[kBefore] - with.op[kBefore]), 1.15 * friction) << seed;
  }
}

TEST(Generator, TheWorstShareIsThatOfAStretchAsLongAsARecord) {
  std::vector<double> op(5 * kSamples, 50.0);
  std::fill_n(op.begin() + 100, kSamples / 4, 0.0);
  std::fill_n(op.begin() + 3 * kSamples - 10, kSamples / 8, 100.0);
  std::fill_n(op.begin() + 4 * kSamples - 1100, kSamples / 4, 0.0);
  EXPECT_DOUBLE_EQ(worst_share_at_limit(op), 0.375);
  EXPECT_DOUBLE_EQ(share_at_limit(op), 0.125);
}

TEST(Generator, LoadsThatWouldIntegrateReturnInTheLongRun) {
  // Integrating, the best of 12 draws has op at its limit for 74 to 100 % of the worst stretch.
  for (const std::uint64_t seed : {25U, 63U, 97U, 173U}) {
    const Record record = generate_onset("healthy_still", seed, 4 * kSamples, 26 * kSamples);
    EXPECT_LE(worst_share_at_limit(record.op), kMostAtLimit) << seed;
  }
}

TEST(Generator, TankKeepsTheGainOfTheLoopAtItsOperatingPoint) {
  std::uint64_t seed = 0;
  Finished finished = finish("process_nonlinearity", seed);
  while (!finished.draft.scenario.process.loss) finished = finish("process_nonlinearity", ++seed);
  const Scenario& scenario = finished.draft.scenario;
  const double slope =
      (resting_pv(scenario, scenario.op0 + 0.01) - resting_pv(scenario, scenario.op0 - 0.01)) /
      0.02;
  EXPECT_NEAR(slope / finished.draft.base.process.gain, 1.0, 1e-3);
}

TEST(Generator, KnowsNothingOfTheModelNorOfTheSimulationsOfCore) {
  const std::set<std::string> judges = {
      "draws.cpp",          "draws.hpp",        "field_draws.cpp",    "outcome.hpp",
      "outcome.cpp",        "outcome_test.cpp", "residual_tests.hpp", "residual_tests.cpp",
      "generator_test.cpp", "window_of.hpp"};
  for (const char* folder : {"tests/effects", "tests/generators"})
    for (const auto& file : std::filesystem::directory_iterator(source_dir() / folder)) {
      if (judges.contains(file.path().filename().string())) continue;
      std::stringstream text;
      text << std::ifstream(file.path()).rdbuf();
      EXPECT_EQ(text.str().find("#include \"core/"), std::string::npos) << file.path();
    }
}

}  // namespace
}  // namespace loopscope::tests::effects
