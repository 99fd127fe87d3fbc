#include "core/diagnosis/odds/cause_odds.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "core/diagnosis/odds/cause_curves.hpp"
#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

double odds(double probability) {
  return probability / (1.0 - probability);
}

const WeighedCause& cause_in(const std::vector<WeighedCause>& causes, VerdictCode code) {
  return *std::ranges::find(causes, code, &WeighedCause::code);
}

TEST(CauseOdds, AreTheSumOfTheirPartsTheWeightiestFirst) {
  const Evidence evidence = evidence_with(explanation_of());
  for (const WeighedCause& cause : weigh_causes(evidence, {})) {
    const auto curves =
        std::ranges::find(fitted_curves(true), name(cause.code), &CauseCurves::cause);
    double sum = curves->beside.scale * curves->log_odds + curves->beside.offset;
    for (const Part& part : cause.parts) sum += part.weight;
    EXPECT_NEAR(cause.log_odds, sum, 1e-9);
    for (std::size_t k = 1; k < cause.parts.size(); ++k)
      EXPECT_GE(std::abs(cause.parts[k - 1].weight), std::abs(cause.parts[k].weight));
  }
}

/// What the figures of a cause say of it is kept apart from the others and from the plant.
TEST(CauseOdds, TheEvidenceKnowsNeitherPriorsNorOthers) {
  const Evidence evidence =
      evidence_with(explanation_of({clear_step(model::EffectKind::valve_stiction)}));
  DecisionSettings settings;
  settings.priors.valve_stiction = 0.5;
  settings.priors.external_disturbance = 0.01;
  const auto elsewhere = weigh_causes(evidence, settings);
  for (const WeighedCause& cause : weigh_causes(evidence)) {
    const auto curves =
        std::ranges::find(fitted_curves(true), name(cause.code), &CauseCurves::cause);
    double own = curves->log_odds - std::log(odds(curves->share));
    for (const Part& part : cause.parts)
      own += part.figure ? part.weight / curves->beside.scale : 0.0;
    EXPECT_NEAR(cause.evidence, own, 1e-9);
    EXPECT_NEAR(cause_in(elsewhere, cause.code).evidence, cause.evidence, 1e-12);
  }
}

TEST(CauseOdds, APriorMultipliesTheOddsByWhatItIsToThatOfTheFit) {
  const Evidence evidence = quiet_evidence();
  const auto plain = weigh_causes(evidence);
  DecisionSettings settings;
  settings.priors.valve_stiction = 0.02;
  const auto shifted = weigh_causes(evidence, settings);
  const auto& curves = fitted_curves(false);
  const double share = std::ranges::find(curves, "valve_stiction", &CauseCurves::cause)->share;
  const double before = odds(cause_in(plain, VerdictCode::valve_stiction).probability());
  const double after = odds(cause_in(shifted, VerdictCode::valve_stiction).probability());
  EXPECT_NEAR(after / before, odds(0.02) / odds(share), 1e-9);
  EXPECT_EQ(cause_in(shifted, VerdictCode::healthy).prior,
            cause_in(plain, VerdictCode::healthy).prior);
}

/// Where no valve sticks, what looks like it has another cause.
TEST(CauseOdds, ARivalCountsByThePlantsPrior) {
  const Evidence evidence =
      evidence_with(explanation_of({clear_step(model::EffectKind::valve_stiction)}));
  const auto odds_of_deadband = [&](double prior) {
    DecisionSettings settings;
    settings.priors.valve_stiction = prior;
    return cause_in(weigh_causes(evidence, settings), VerdictCode::valve_deadband).log_odds;
  };
  EXPECT_GT(odds_of_deadband(1e-4), odds_of_deadband(0.5));
}

TEST(CauseOdds, AStepOfTheModelRaisesItsCause) {
  const auto weighed = [](std::vector<model::Step> steps, VerdictCode code) {
    return cause_in(weigh_causes(evidence_with(explanation_of(std::move(steps)))), code).log_odds;
  };
  EXPECT_GT(weighed({clear_step(model::EffectKind::gain_change)}, VerdictCode::process_change),
            weighed({}, VerdictCode::process_change) + 2.0);
  EXPECT_GT(weighed({clear_step(model::EffectKind::load_step)}, VerdictCode::external_disturbance),
            weighed({}, VerdictCode::external_disturbance) + 1.0);
  EXPECT_LT(weighed({clear_step(model::EffectKind::external_oscillation)}, VerdictCode::healthy),
            weighed({}, VerdictCode::healthy));
}

TEST(CauseOdds, SettingsOutOfRangeAreRefused) {
  DecisionSettings settings;
  EXPECT_NO_THROW(check(settings));
  settings.line = 1.5;
  EXPECT_THROW(check(settings), std::invalid_argument);
  settings = {};
  settings.priors.tight_tuning = 1.0;
  EXPECT_THROW(check(settings), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
