#include "daemon/report/figures/residual_pairs.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace loopscope::daemon {
namespace {

using core::model::EffectKind;
using core::model::TraceStage;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kSamples = 1000;
/// The load step of the second stage comes here, late in the record.
constexpr std::size_t kStep = 800;

std::vector<double> series(double height, double at_step) {
  std::vector<double> values(kSamples);
  for (std::size_t k = 0; k < kSamples; ++k) values[k] = k % 2 == 0 ? height : -height;
  values[kStep] = at_step;
  return values;
}

TraceStage stage(std::optional<EffectKind> effect, std::vector<double> residual) {
  TraceStage made;
  made.effect = effect;
  made.one_step_residual = std::move(residual);
  return made;
}

/// A valve step that halves the residual, then a load step that takes its one spike.
LoopEvidence evidence() {
  LoopEvidence seen;
  core::signal::LoopWindow& window = seen.at_slot.window;
  window.start_us = 1'772'366'400'000'000;
  window.pv.assign(kSamples, 1.0);
  seen.prepared.sample_interval_s = 1.0;
  for (std::size_t k = 0; k < kSamples; ++k)
    seen.prepared.op_percent.push_back(50.0 + std::sin(0.1 * static_cast<double>(k)));
  core::model::ExplanationTraces& traces = seen.traces.emplace();
  traces.explanation.excited = true;
  traces.measured = window.pv;
  traces.telling_from = 100;
  traces.telling_samples = 200;
  traces.stages = {stage(std::nullopt, series(2.0, 9.0)),
                   stage(EffectKind::valve_stiction, series(1.0, 9.0)),
                   stage(EffectKind::load_step, series(1.0, 1.0))};
  return seen;
}

/// The line of a script that begins with these words.
std::string line_of(const Figure& figure, const std::string& words) {
  const std::size_t at = figure.script.find(words);
  return figure.script.substr(at, figure.script.find('\n', at) - at);
}

TEST(ResidualPairs, BothFiguresOfAStepHaveOneScaleAndOneStretch) {
  const std::vector<ResidualPair> pairs = residual_pairs(evidence(), {});
  ASSERT_EQ(pairs.size(), 2U);
  for (const ResidualPair& pair : pairs) {
    EXPECT_EQ(line_of(pair.before, "set yrange"), line_of(pair.after, "set yrange"));
    EXPECT_EQ(line_of(pair.before, "set xrange"), line_of(pair.after, "set xrange"));
    EXPECT_NE(pair.before.script, pair.after.script);
    EXPECT_EQ(pair.before.width, pair.after.width);
  }
  EXPECT_EQ(pairs[0].step, 0U);
  EXPECT_EQ(pairs[1].step, 1U);
  EXPECT_THAT(pairs[0].after.alt, HasSubstr("with valve stiction"));
}

/// Where the first effect tells, this one need not be seen.
TEST(ResidualPairs, EachEffectIsShownWhereItTells) {
  const std::vector<ResidualPair> pairs = residual_pairs(evidence(), {});
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_THAT(pairs[1].before.script, HasSubstr(" 9\n"));
  EXPECT_THAT(pairs[1].after.script, Not(HasSubstr(" 9\n")));
}

TEST(ResidualPairs, AStepThatChangesNothingShowsTheStretchOfTheFirstEffect) {
  LoopEvidence seen = evidence();
  seen.traces->stages[2].one_step_residual = seen.traces->stages[1].one_step_residual;
  const std::vector<ResidualPair> pairs = residual_pairs(seen, {});
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_THAT(pairs[1].before.script, HasSubstr("set xrange [1772366500.000:1772366699.000]"));
}

TEST(ResidualPairs, WhereAStageHasNoPredictionTheSimulationStandsForIt) {
  LoopEvidence seen = evidence();
  seen.traces->stages.resize(2);
  seen.traces->stages[1].one_step_residual.clear();
  EXPECT_TRUE(residual_pairs(seen, {}).empty()) << "neither";
  seen.traces->stages[0].simulated.assign(kSamples, 4.0);
  seen.traces->stages[1].simulated.assign(kSamples, 0.5);
  const std::vector<ResidualPair> pairs = residual_pairs(seen, {});
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_THAT(pairs[0].before.script, HasSubstr(" -3\n"));
  EXPECT_THAT(pairs[0].after.script, HasSubstr(" 0.5\n"));
}

TEST(ResidualPairs, AModelThatClaimsNothingHasNone) {
  LoopEvidence seen = evidence();
  seen.traces->explanation.excited = false;
  EXPECT_TRUE(residual_pairs(seen, {}).empty());
  seen.traces.reset();
  EXPECT_TRUE(residual_pairs(seen, {}).empty());
}

}  // namespace
}  // namespace loopscope::daemon
