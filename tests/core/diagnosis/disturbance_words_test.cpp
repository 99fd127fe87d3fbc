#include "core/diagnosis/disturbance_words.hpp"

#include <gtest/gtest.h>

#include "core/diagnosis/decide.hpp"
#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using enum model::EffectKind;

model::Step load_at(double at_s, double before = 1.0, double after = 0.5) {
  model::Step step = clear_step(load_step, before, after);
  step.parameters = {{"at", "s", at_s, {}, {}}, {"size", "pv", 1.0, {}, {}}};
  return step;
}

/// With a process that answers within 100 s.
model::Explanation explanation_with(std::vector<model::Step> steps) {
  model::Explanation explanation = explanation_of(std::move(steps));
  explanation.baseline.process.delay_s = 20.0;
  explanation.baseline.process.time_constant_s = 80.0;
  return explanation;
}

TEST(DisturbanceWords, AWaveAStepAndSeveralAreToldApart) {
  const model::Step wave = clear_step(external_oscillation);
  EXPECT_EQ(disturbance_of(explanation_with({})), Disturbance::none);
  EXPECT_EQ(disturbance_of(explanation_with({clear_step(valve_stiction)})), Disturbance::none);
  EXPECT_EQ(disturbance_of(explanation_with({wave})), Disturbance::wave);
  EXPECT_EQ(disturbance_of(explanation_with({load_at(500.0)})), Disturbance::moved_once);
  EXPECT_EQ(disturbance_of(explanation_with({load_at(500.0), load_at(900.0)})), Disturbance::moved);
}

TEST(DisturbanceWords, TwoStepsWithinOneAnswerOfTheProcessAreOneMove) {
  EXPECT_EQ(load_moves(explanation_with({load_at(550.0), load_at(500.0)})), 1U);
  EXPECT_EQ(load_moves(explanation_with({load_at(500.0), load_at(601.0), load_at(650.0)})), 2U);
}

TEST(DisturbanceWords, WhatExplainsMoreLeads) {
  const model::Step wave = clear_step(external_oscillation, 0.5, 0.4);
  EXPECT_EQ(disturbance_of(explanation_with({load_at(500.0, 1.0, 0.5), wave})),
            Disturbance::moved_once);
  EXPECT_EQ(disturbance_of(explanation_with({load_at(500.0, 0.5, 0.45), wave})), Disturbance::wave);
}

TEST(DisturbanceWords, ALoadOfWhichTheResidualStillShowsMoreKeepsMoving) {
  model::Explanation explanation = explanation_with({load_at(500.0), load_at(900.0)});
  explanation.questions = {{"time_event", 0.011, ""}};
  EXPECT_EQ(disturbance_of(explanation), Disturbance::moved);
  explanation.questions = {{"time_event", 0.009, ""}};
  EXPECT_EQ(disturbance_of(explanation), Disturbance::keeps_moving);
}

TEST(DisturbanceWords, LoadsThatComeWithTheAnswerToTheSetpointDoNotCount) {
  model::Step answer = load_at(500.0);
  answer.setpoint_chance = 0.01;
  EXPECT_EQ(disturbance_of(explanation_with({answer})), Disturbance::none);
  EXPECT_EQ(load_moves(explanation_with({answer, load_at(900.0)})), 1U);
}

TEST(DisturbanceWords, EachIsSaidInWordsOfItsOwn) {
  const model::Explanation loads =
      explanation_with({load_at(500.0), load_at(900.0), load_at(1400.0)});
  struct Case {
    Disturbance disturbance;
    const char* summary;
    const char* action;
  };
  for (const Case& one :
       {Case{Disturbance::wave, "An oscillation reaches the loop from outside.",
             "Find the loop or unit with the same period before changing this loop."},
        Case{Disturbance::moved_once, "The load moved once within the window.",
             "Check what was changed upstream at that time; the loop itself needs no change."},
        Case{Disturbance::moved, "The load moved 3 times within the window.",
             "Compare these times with feeds, utilities and the operators' log; where the load "
             "can be measured, consider feedforward."},
        Case{Disturbance::keeps_moving, "The load keeps moving.",
             "Check what feeds this loop (supply pressure, upstream level, composition): it moves "
             "without a period. Where it can be measured, consider feedforward."}}) {
    const DisturbanceWords words = words_of(one.disturbance, loads);
    EXPECT_EQ(words.summary, one.summary);
    EXPECT_EQ(words.action, one.action);
  }
  EXPECT_EQ(
      words_of(Disturbance::moved, explanation_with({load_at(500.0), load_at(900.0)})).summary,
      "The load moved twice within the window.");
}

TEST(DisturbanceWords, TheVerdictSpeaksThem) {
  DecisionSettings decision;
  decision.priors.external_disturbance = 0.99;
  const Verdict verdict = decide(evidence_with(explanation_with({load_at(500.0)})), {}, decision);
  EXPECT_EQ(verdict.code, VerdictCode::external_disturbance);
  EXPECT_EQ(verdict.summary, "The load moved once within the window.");
  EXPECT_NE(verdict.action.find("upstream"), std::string::npos);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
