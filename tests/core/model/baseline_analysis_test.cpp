#include "core/model/baseline_analysis.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

/// A flow loop whose setpoint moves.
struct MovingLoop {
  simulate::LoopRecord record = tests::noiseless_loop(simulate::LoadStep{.at_s = 1e9}, 5.0);
  tests::Series pv = tests::sum(record.pv, tests::white_noise(record.pv.size(), 1, 0.05));
  tests::Series error = simulate::control_error(record);
  [[nodiscard]] ModelInput input() const {
    return {pv, record.op, record.sp, error, record.sample_interval_s};
  }
};

TEST(BaselineAnalysis, TheLinearLoopAloneHasNoSteps) {
  const MovingLoop recorded;
  const BaselineAnalysis analysis = analyse_baseline(recorded.input());
  const Explanation linear = report_linear_model(analysis);
  EXPECT_TRUE(linear.steps.empty());
  EXPECT_EQ(linear.baseline.holdout_error, analysis.baseline_error());
  EXPECT_TRUE(linear.excited);
  ASSERT_TRUE(linear.closed_loop);
}

TEST(BaselineAnalysis, BothHalvesAreScored) {
  const MovingLoop recorded;
  const BaselineAnalysis analysis = analyse_baseline(recorded.input());
  const double square = analysis.stepwise.data.pv_scale * analysis.stepwise.data.pv_scale;
  const double one = analysis.baseline_error();
  const double other = analysis.stepwise.baseline.other_fold.score_error * square;
  EXPECT_GE(analysis.error_of_both_halves(), std::min(one, other));
  EXPECT_LE(analysis.error_of_both_halves(), std::max(one, other));
}

/// The controller waits for a held sensor by half a hold in the mean, which makes the same process
/// harder to control.
TEST(BaselineAnalysis, AHeldSensorDelaysTheImpliedLoop) {
  const MovingLoop recorded;
  const Explanation whole = report_linear_model(analyse_baseline(recorded.input()));
  const RowGrid grid{5, 0};
  const tests::Series pv = at_rows(grid, recorded.pv), op = at_rows(grid, recorded.record.op);
  const ModelInput rows{pv, op, {}, {}, 5.0 * recorded.record.sample_interval_s};
  const Explanation held = report_linear_model(analyse_baseline(recorded.input(), rows, grid));
  EXPECT_NEAR(held.baseline.process.gain, tests::kNoiselessGain, 0.05);
  ASSERT_TRUE(whole.closed_loop && held.closed_loop);
  EXPECT_GT(held.closed_loop->peak_sensitivity, whole.closed_loop->peak_sensitivity);
}

/// What the residual tests say of the linear loop is what the search starts from, and what is
/// reported where there is none.
TEST(BaselineAnalysis, TheLinearReportIsWhatTheTestsSaid) {
  const MovingLoop recorded;
  const BaselineAnalysis analysis = analyse_baseline(recorded.input());
  const Explanation linear = report_linear_model(analysis);
  ASSERT_EQ(linear.questions.size(), analysis.answers.size());
  for (const Question& question : linear.questions)
    EXPECT_EQ(question.p, p_of(analysis.answers, question.name)) << question.name;
}

}  // namespace
}  // namespace loopscope::core::model
