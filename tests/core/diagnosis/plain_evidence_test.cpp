#include "core/diagnosis/plain_evidence.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace loopscope::core::diagnosis {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
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
    "The error is 1.3 to 2 times the least that this process and its noise allow.";
const std::string kNoWave = "The error does not oscillate regularly.";

TEST(PlainEvidence, TellsWhatTheNamedEffectDoes) {
  Evidence evidence = measured();
  evidence.model->steps = {
      step_of(model::EffectKind::load_step, 4.0, 2.0, "The load moved."),
      step_of(model::EffectKind::valve_stiction, 2.0, 1.5, "It sticks a little."),
      step_of(model::EffectKind::valve_stiction, 1.5, 0.5, "It sticks.")};
  EXPECT_THAT(plain_evidence(VerdictCode::valve_stiction, evidence),
              ElementsAre("It sticks.", kLarger));
  EXPECT_THAT(plain_evidence(VerdictCode::valve_deadband, evidence),
              ElementsAre("It sticks.", kLarger))
      << "the diagnosis takes one for the other";
  EXPECT_THAT(plain_evidence(VerdictCode::external_disturbance, evidence),
              ElementsAre("The load moved."))
      << "no tuning is called for";
  EXPECT_THAT(plain_evidence(VerdictCode::tight_tuning, evidence), ElementsAre(kLarger));
  EXPECT_THAT(plain_evidence(VerdictCode::sensor_fault, evidence), IsEmpty())
      << "the model has no such effect, and pv cannot be trusted";
}

TEST(PlainEvidence, AStepThatTheCycleTurnedIsToldOfEither) {
  Evidence evidence = measured();
  evidence.model->steps = {
      step_of(model::EffectKind::valve_deadband, 2.0, 1.0, "The valve has dead band.")};
  evidence.model->steps[0].cycle_indicates_stiction = true;
  for (const VerdictCode code : {VerdictCode::valve_deadband, VerdictCode::valve_stiction})
    EXPECT_EQ(plain_evidence(code, evidence).front(), "The valve has dead band.");
}

TEST(PlainEvidence, ThreeThingsFromOutsideAreTold) {
  Evidence evidence = measured();
  evidence.model->steps = {step_of(model::EffectKind::load_step, 4.0, 2.0, "The load moved."),
                           step_of(model::EffectKind::external_oscillation, 2.0, 0.5, "A wave."),
                           step_of(model::EffectKind::load_step, 0.5, 0.49, "It moved a little."),
                           step_of(model::EffectKind::load_step, 0.49, 0.3, "It moved back.")};
  evidence.oscillation.present = true;
  evidence.oscillation.period_s = 20.0;
  evidence.oscillation.amplitude = 1.0;
  EXPECT_THAT(plain_evidence(VerdictCode::external_disturbance, evidence),
              ElementsAre("A wave.", "The load moved.", "It moved back."));
}

TEST(PlainEvidence, WithoutAStepItTellsThatNothingInTheLoopAccountsForTheError) {
  Evidence evidence = measured();
  EXPECT_THAT(plain_evidence(VerdictCode::external_disturbance, evidence), IsEmpty());
  evidence.model->unexplained.fraction = 0.7;
  EXPECT_THAT(plain_evidence(VerdictCode::external_disturbance, evidence),
              ElementsAre("Nothing found in valve, process or sensor accounts for 70 % of the "
                          "error that could be foreseen."));
}

TEST(PlainEvidence, TellsHowLongTheOutputIsAtItsLimit) {
  Evidence evidence;
  EXPECT_THAT(plain_evidence(VerdictCode::valve_saturation, evidence), IsEmpty());
  evidence.op_at_ends.emplace().share = 0.2;
  EXPECT_THAT(plain_evidence(VerdictCode::valve_saturation, evidence),
              ElementsAre("The controller output rests at an end of its travel in 20 % of the "
                          "samples."));
  evidence.data_quality.saturated_fraction = 0.1;
  EXPECT_THAT(plain_evidence(VerdictCode::valve_saturation, evidence),
              ElementsAre("The controller output is at a limit of its range in 10 % of the "
                          "samples."));
}

TEST(PlainEvidence, AnEffectThatCannotBeConfirmedIsNotTold) {
  Evidence evidence = measured();
  evidence.model->excited = false;
  evidence.model->steps = {step_of(model::EffectKind::valve_stiction, 2.0, 1.0, "It sticks.")};
  EXPECT_THAT(plain_evidence(VerdictCode::valve_stiction, evidence), ElementsAre(kLarger));
}

TEST(PlainEvidence, TellsHowALoopSettlesWhoseTuningIsBlamed) {
  Evidence evidence = measured();
  model::ClosedLoop& loop = evidence.model->closed_loop.emplace();
  loop.peak_sensitivity = 3.0;
  loop.settling_s = 320.0;
  loop.period_s = 9.5;
  loop.damping = 0.2154;  // a decay ratio of a quarter
  const std::string start = "With these settings of the controller ";
  EXPECT_EQ(plain_evidence(VerdictCode::tight_tuning, evidence).front(),
            start +
                "the loop swings with a period of 9.5 s after a disturbance, each swing 25 % of "
                "the one before.");
  loop.period_s = 0.0;
  EXPECT_EQ(plain_evidence(VerdictCode::sluggish_tuning, evidence).front(),
            start + "a disturbance takes 5.33 min to settle, without oscillation.");
  loop.peak_sensitivity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(plain_evidence(VerdictCode::tight_tuning, evidence).front(),
            start + "the fitted loop is unstable.");
  EXPECT_THAT(plain_evidence(VerdictCode::valve_stiction, evidence), ElementsAre(kLarger));
}

TEST(PlainEvidence, TellsThatNothingIsNeededWhereALinearLoopExplainsTheRecord) {
  Evidence evidence = measured();
  const std::string linear = "A linear loop with noise explains what was recorded";
  EXPECT_THAT(plain_evidence(VerdictCode::healthy, evidence),
              ElementsAre(StartsWith(linear), kLarger, kNoWave));
  evidence.model->unexplained.fraction = 0.5;
  EXPECT_THAT(plain_evidence(VerdictCode::healthy, evidence), ElementsAre(kLarger, kNoWave));
  evidence.model->unexplained.fraction = 0.0;
  evidence.model->steps = {step_of(model::EffectKind::load_step, 4.0, 2.0, "The load moved.")};
  EXPECT_THAT(plain_evidence(VerdictCode::healthy, evidence), ElementsAre(kLarger, kNoWave));
}

TEST(PlainEvidence, TellsHowMuchLargerTheErrorIsThanItsLeast) {
  const auto said = [](double low, double high) {
    Evidence evidence = measured();
    evidence.performance.harris_low = low;
    evidence.performance.harris_high = high;
    return plain_evidence(VerdictCode::unexplained, evidence).front();
  };
  const std::string best = " times the least that this process and its noise allow.";
  EXPECT_EQ(said(0.9, 0.95), "The error is about as small as this process and its noise allow.");
  EXPECT_EQ(said(0.82, 0.99), "The error is about as small as this process and its noise allow.");
  EXPECT_EQ(said(0.25, 0.99), "The error is up to 2" + best);
  EXPECT_EQ(said(0.25, 0.2501), "The error is 2" + best);
  EXPECT_EQ(said(0.25, 0.64), kLarger);
  Evidence level = measured();
  level.integrating = true;
  EXPECT_THAT(plain_evidence(VerdictCode::unexplained, level), IsEmpty());
  EXPECT_THAT(plain_evidence(VerdictCode::valve_saturation, measured()), IsEmpty());
}

}  // namespace
}  // namespace loopscope::core::diagnosis
