#include "daemon/report/figures/shown_model.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using core::model::TraceStage;
using Series = std::vector<double>;

/// A stage whose simulation is `off` beside a measurement of zeros, with a gap at its start.
TraceStage stage_off(double off) {
  TraceStage stage;
  stage.simulated = Series(100, off);
  stage.simulated.front() = std::nan("");
  stage.one_step_prediction = Series(100, 0.5);
  return stage;
}

bool simulated(const std::vector<TraceStage>& stages) {
  std::vector<const TraceStage*> shown;
  for (const TraceStage& stage : stages) shown.push_back(&stage);
  return shown_model(Series(100, 0.0), shown, 0, 100).simulated;
}

TEST(ShownModel, ASimulationThatComesNearerIsShown) {
  EXPECT_TRUE(simulated({stage_off(3.0), stage_off(2.0), stage_off(1.0)}));
  EXPECT_TRUE(simulated({stage_off(3.0), stage_off(3.0)}))
      << "a grid of the sensor changes nothing";
}

TEST(ShownModel, OneThatRunsAwayGivesWayToWhatWasScored) {
  EXPECT_FALSE(simulated({stage_off(1.0), stage_off(2.0)}));
  EXPECT_FALSE(simulated({stage_off(3.0), stage_off(1.0), stage_off(2.0)}));
  EXPECT_FALSE(simulated({stage_off(1.0), stage_off(std::nan(""))}));
}

TEST(ShownModel, AStageThatWasScoredByItsSimulationIsShownByIt) {
  TraceStage cycle = stage_off(2.0);
  cycle.one_step_prediction.clear();
  EXPECT_TRUE(simulated({stage_off(1.0), cycle}));
}

TEST(ShownModel, OnlyWhatIsShownCounts) {
  TraceStage after = stage_off(1.0);
  for (std::size_t k = 50; k < 100; ++k) after.simulated[k] = 9.0;
  const TraceStage before = stage_off(2.0);
  const Series measured(100, 0.0);
  EXPECT_TRUE(shown_model(measured, {&before, &after}, 0, 50).simulated);
  EXPECT_FALSE(shown_model(measured, {&before, &after}, 0, 100).simulated);
}

TEST(ShownModel, NamesWhatItShows) {
  const TraceStage stage = stage_off(1.0);
  EXPECT_EQ(&ShownModel{true}.series_of(stage), &stage.simulated);
  EXPECT_EQ(&ShownModel{false}.series_of(stage), &stage.one_step_prediction);
  EXPECT_NE(ShownModel{true}.words(), ShownModel{false}.words());
}

}  // namespace
}  // namespace loopscope::daemon
