#include "core/diagnosis/plain_evidence.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace loopscope::core::diagnosis {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

model::Step step_of(model::EffectKind effect, double before, double after,
                    const std::string& statement) {
  model::Step step;
  step.effect = effect;
  step.holdout_error_before = before;
  step.holdout_error_after = after;
  step.statement = statement;
  return step;
}

Evidence measured() {
  Evidence evidence;
  evidence.performance.harris_low = 0.25;
  evidence.performance.harris_high = 0.64;
  evidence.model.emplace().excited = true;
  return evidence;
}

const std::string kLarger =
    "The error is 1.3 to 2 times as large as the best controller could "
    "make it.";
const std::string kNoWave = "The error does not oscillate regularly.";

TEST(PlainEvidence, TellsWhatTheNamedEffectDoes) {
  Evidence evidence = measured();
  evidence.model->steps = {
      step_of(model::EffectKind::load_step, 4.0, 2.0, "The load moved."),
      step_of(model::EffectKind::valve_stiction, 2.0, 1.5, "It sticks a little."),
      step_of(model::EffectKind::valve_stiction, 1.5, 0.5, "It sticks.")};
  EXPECT_THAT(plain_evidence(VerdictCode::valve_stiction, evidence),
              ElementsAre("It sticks.", kLarger, kNoWave));
  EXPECT_THAT(plain_evidence(VerdictCode::external_disturbance, evidence),
              ElementsAre("The load moved.", kLarger, kNoWave));
  EXPECT_THAT(plain_evidence(VerdictCode::sensor_fault, evidence), ElementsAre(kLarger, kNoWave))
      << "the model has no such effect";
}

TEST(PlainEvidence, AnEffectThatCannotBeConfirmedIsNotTold) {
  Evidence evidence = measured();
  evidence.model->excited = false;
  evidence.model->steps = {step_of(model::EffectKind::valve_stiction, 2.0, 1.0, "It sticks.")};
  EXPECT_THAT(plain_evidence(VerdictCode::valve_stiction, evidence), ElementsAre(kLarger, kNoWave));
}

TEST(PlainEvidence, TellsHowALoopSettlesWhoseTuningIsBlamed) {
  Evidence evidence = measured();
  model::ClosedLoop& loop = evidence.model->closed_loop.emplace();
  loop.peak_sensitivity = 3.0;
  loop.settling_s = 320.0;
  loop.period_s = 9.5;
  EXPECT_EQ(plain_evidence(VerdictCode::tight_tuning, evidence).front(),
            "With these settings of the controller a disturbance takes 5.33 min to settle, and "
            "oscillates with a period of 9.5 s meanwhile.");
  loop.period_s = 0.0;
  EXPECT_EQ(plain_evidence(VerdictCode::sluggish_tuning, evidence).front(),
            "With these settings of the controller a disturbance takes 5.33 min to settle, without "
            "oscillation.");
  loop.peak_sensitivity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(plain_evidence(VerdictCode::tight_tuning, evidence).front(),
            "With these settings of the controller the fitted loop is unstable.");
  EXPECT_THAT(plain_evidence(VerdictCode::valve_stiction, evidence), ElementsAre(kLarger, kNoWave));
}

TEST(PlainEvidence, TellsThatNothingIsNeeded) {
  Evidence evidence = measured();
  EXPECT_THAT(plain_evidence(VerdictCode::healthy, evidence).front(),
              StartsWith("A linear loop with noise explains what was recorded"));
  evidence.model->steps = {step_of(model::EffectKind::load_step, 4.0, 2.0, "The load moved.")};
  EXPECT_THAT(plain_evidence(VerdictCode::healthy, evidence), ElementsAre(kLarger, kNoWave));
}

TEST(PlainEvidence, TellsWhatTheErrorCostsAndItsPeriod) {
  Evidence evidence = measured();
  evidence.performance.harris_low = 0.9;
  evidence.performance.harris_high = 0.95;
  evidence.oscillation.present = true;
  evidence.oscillation.period_s = 56.3;
  evidence.oscillation.amplitude = 1.0;
  evidence.performance.error_std = 1.0;
  EXPECT_THAT(plain_evidence(VerdictCode::unexplained, evidence),
              ElementsAre("The error is about as small as any controller could make it.",
                          "The error oscillates with a period of 56.3 s."));
  evidence.performance.harris_high = std::nullopt;
  EXPECT_EQ(plain_evidence(VerdictCode::unexplained, evidence).size(), 1U);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
