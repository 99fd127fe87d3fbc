#include "core/diagnosis/cause_odds.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "core/diagnosis/cause_curves.hpp"
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
  for (const WeighedCause& cause : weigh_causes(evidence)) {
    const auto curves =
        std::ranges::find(fitted_curves(true), name(cause.code), &CauseCurves::cause);
    double sum = curves->scale * curves->log_odds + curves->offset;
    for (const Part& part : cause.parts) sum += part.weight;
    EXPECT_NEAR(cause.log_odds, sum, 1e-9);
    for (std::size_t k = 1; k < cause.parts.size(); ++k)
      EXPECT_GE(std::abs(cause.parts[k - 1].weight), std::abs(cause.parts[k].weight));
  }
}

TEST(CauseOdds, WhatAnotherCauseExplainsNeedsNoSecondOne) {
  const auto weight_of_rival = [](double load_evidence) {
    model::Step load = clear_step(model::EffectKind::load_step);
    load.evidence = load_evidence;
    const auto causes = weigh_causes(evidence_with(explanation_of({load})));
    const WeighedCause& cause = cause_in(causes, VerdictCode::tight_tuning);
    return std::ranges::find_if(cause.parts, [](const Part& part) { return !part.figure; })->weight;
  };
  EXPECT_LE(weight_of_rival(3000.0), weight_of_rival(0.0)) << "a load in the place of a tuning";
  for (const CauseCurves& curves : fitted_curves(true)) {
    for (std::size_t k = 1; k < curves.rival.size(); ++k)
      EXPECT_LE(curves.rival[k].weight, curves.rival[k - 1].weight) << curves.cause;
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

/// Rivals are taken to be independent: that any is there is 1 less that none is.
TEST(CauseOdds, TheOtherCausesCountTogether) {
  const auto causes = weigh_causes(evidence_with(explanation_of()));
  const auto curves_of = [](const WeighedCause& cause) {
    return std::ranges::find(fitted_curves(true), name(cause.code), &CauseCurves::cause);
  };
  const auto none_of = [&](const WeighedCause& cause) {
    const auto curves = curves_of(cause);
    if (curves->rival.empty()) return 1.0;
    double own = curves->log_odds;
    for (const Part& part : cause.parts) own += part.figure ? part.weight / curves->scale : 0.0;
    return 1.0 / (1.0 + std::exp(own));
  };
  for (const WeighedCause& cause : causes) {
    if (curves_of(cause)->rival.empty()) continue;
    double none = 1.0;
    for (const WeighedCause& other : causes)
      if (other.code != cause.code) none *= none_of(other);
    const auto rivals = std::ranges::find_if(cause.parts, [](const Part& p) { return !p.figure; });
    EXPECT_NEAR(*rivals->value, 1.0 - none, 1e-9) << name(cause.code);
  }
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
