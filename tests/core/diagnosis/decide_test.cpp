#include "core/diagnosis/decide.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/diagnosis/plain_evidence.hpp"
#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

using Code = VerdictCode;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct Given {
  VerdictCode code;
  double probability;
};

std::vector<WeighedCause> causes_of(std::initializer_list<Given> given) {
  std::vector<WeighedCause> causes;
  for (const Given& cause : given)
    causes.push_back(
        {cause.code, std::log(cause.probability / (1.0 - cause.probability)), 0.1, {}});
  return causes;
}

constexpr Circumstances kCalm{};
constexpr Circumstances kStructured{.structured = true};

TEST(Decide, TheMostProbableCauseAboveTheLineIsNamed) {
  const auto causes =
      causes_of({{Code::tight_tuning, 0.7}, {Code::valve_stiction, 0.6}, {Code::healthy, 0.1}});
  EXPECT_EQ(code_for(causes, kCalm, 0.3), Code::tight_tuning);
  EXPECT_EQ(code_for(causes, kCalm, 0.65), Code::tight_tuning);
}

TEST(Decide, HealthIsACauseAmongOthers) {
  const auto causes = causes_of({{Code::healthy, 0.6}, {Code::valve_stiction, 0.35}});
  EXPECT_EQ(code_for(causes, kCalm, 0.3), Code::healthy);
  EXPECT_EQ(code_for(causes, kStructured, 0.3), Code::healthy) << "structure is weighed in it";
}

TEST(Decide, BelowTheLineStructureTellsUnexplainedFromHealthy) {
  const auto causes = causes_of({{Code::valve_stiction, 0.25}, {Code::healthy, 0.2}});
  EXPECT_EQ(code_for(causes, kCalm, 0.3), Code::healthy);
  EXPECT_EQ(code_for(causes, kStructured, 0.3), Code::unexplained);
}

TEST(Decide, ANonlinearityWithoutACauseIsNamedWhereItIsProbable) {
  const auto causes = causes_of(
      {{Code::nonlinear_unexplained, 0.5}, {Code::valve_stiction, 0.28}, {Code::healthy, 0.2}});
  EXPECT_EQ(code_for(causes, kCalm, 0.3), Code::nonlinear_unexplained);
  EXPECT_EQ(
      code_for(causes_of({{Code::nonlinear_unexplained, 0.45}, {Code::healthy, 0.2}}), kCalm, 0.3),
      Code::healthy)
      << "likelier linear";
  EXPECT_EQ(code_for(causes, kCalm, 0.25), Code::valve_stiction) << "a cause says more";
  EXPECT_EQ(
      code_for(causes_of({{Code::healthy, 0.6}, {Code::nonlinear_unexplained, 0.5}}), kCalm, 0.3),
      Code::healthy);
}

TEST(Decide, NoValveIsTooLargeWhereTheRangesAreUnknown) {
  const auto causes =
      causes_of({{Code::valve_oversized, 0.9}, {Code::valve_stiction, 0.4}, {Code::healthy, 0.1}});
  EXPECT_EQ(code_for(causes, kCalm, 0.3), Code::valve_stiction);
  EXPECT_EQ(code_for(causes, {.sizes_known = true}, 0.3), Code::valve_oversized);
}

TEST(Decide, NoValveIsAtItsLimitWhereOpIsSeenAtNone) {
  const auto causes = causes_of({{Code::valve_saturation, 0.6}, {Code::healthy, 0.3}});
  EXPECT_EQ(code_for(causes, kCalm, 0.3), Code::valve_saturation);
  EXPECT_EQ(code_for(causes, {.limit_seen = false}, 0.3), Code::healthy);
}

TEST(Decide, OfValveAndControllerNothingIsSaidWhereOpSaysNothing) {
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 60.0);
  evidence.data_quality.flags = {"op_missing"};
  for (const CauseReport& cause : decide(evidence, {}).causes) {
    EXPECT_FALSE(name(cause.code).starts_with("valve_")) << name(cause.code);
    EXPECT_FALSE(name(cause.code).ends_with("_tuning")) << name(cause.code);
  }
}

TEST(Decide, UnusableDataAreNotJudged) {
  Evidence evidence = quiet_evidence();
  evidence.data_quality.usable = false;
  evidence.data_quality.reason = "pv is constant";
  evidence.hos.reset();
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, Code::insufficient_data);
  EXPECT_EQ(verdict.confidence, 1.0);
  EXPECT_THAT(verdict.reasons, testing::ElementsAre("pv is constant."));
}

TEST(Decide, AControllerThatIsNotInCommandIsAStateAndNoCause) {
  Evidence evidence = quiet_evidence();
  evidence.data_quality.flags = {"sp_not_followed"};
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, Code::unexplained);
  EXPECT_EQ(verdict.confidence, 1.0);
  EXPECT_EQ(verdict.summary, "The controller is not in command, or has no integral action.");
  EXPECT_EQ(verdict.reasons.front(),
            "pv stays many standard deviations away from its setpoint: the controller is not in "
            "command, or has no integral action.");
  EXPECT_EQ(verdict.action,
            "Check whether an override or another controller holds the valve; if that is meant, "
            "disable the loop in the catalogue.");
  EXPECT_THAT(verdict.causes, testing::IsEmpty());
  EXPECT_EQ(verdict.p, std::nullopt);
}

TEST(Decide, ASlowLoopWithoutAFaultIsToldSo) {
  Evidence evidence = quiet_evidence();
  evidence.performance.harris_low = 0.05;
  evidence.performance.harris_high = 0.2;
  DecisionSettings sure;
  sure.priors.healthy = 0.99;
  const Verdict verdict = decide(evidence, {}, sure);
  ASSERT_EQ(verdict.code, Code::healthy);
  EXPECT_EQ(verdict.summary,
            "No fault is probable, but the loop corrects slowly: Harris index 0.05 to 0.2.");
  EXPECT_THAT(verdict.action,
              testing::MatchesRegex(
                  "Nothing has to be repaired. Where the error matters, raise the controller gain "
                  "or speed up the integral action in small steps .sluggish tuning is [0-9]+ % "
                  "probable.."));
  evidence.performance.harris_high = 0.5;
  EXPECT_EQ(decide(evidence, {}, sure).action, "Nothing to do.");
}

TEST(Decide, ConfidenceIsTheProbabilityOfTheCode) {
  for (const Evidence& evidence :
       {quiet_evidence(), evidence_with(explanation_of()),
        evidence_with(explanation_of({clear_step(model::EffectKind::valve_stiction)}))}) {
    const Verdict verdict = decide(evidence, {});
    const auto own = std::ranges::find(verdict.causes, verdict.code, &CauseReport::code);
    ASSERT_NE(own, verdict.causes.end());
    EXPECT_EQ(verdict.confidence, own->probability);
  }
}

TEST(Decide, OfWhatIsUnexplainedConfidenceIsWhatNoCauseTakes) {
  DecisionSettings strict;
  strict.line = 1.0;
  Evidence evidence = quiet_evidence();
  oscillate(evidence, 60.0);
  const Verdict verdict = decide(evidence, {}, strict);
  ASSERT_EQ(verdict.code, Code::unexplained);
  EXPECT_DOUBLE_EQ(verdict.confidence, 1.0 - verdict.causes.front().probability);
}

/// Several windows that show a nonlinearity and no cause of it.
CombinedOdds nothing_but_nonlinear() {
  CombinedOdds combined;
  for (const VerdictCode code : all_verdict_codes()) {
    if (code > Code::nonlinear_unexplained) break;
    set_cause(combined.evidence, code, code == Code::nonlinear_unexplained ? 6.0 : -6.0);
    set_cause(combined.windows, code, 1.0);
  }
  return combined;
}

TEST(Decide, WhatToRecordFollowsFromWhatIsRecorded) {
  Evidence evidence = quiet_evidence();
  evidence.hos->nonlinear_p = 1e-9;
  const CombinedOdds combined = nothing_but_nonlinear();
  for (const char* flag : {"op_missing", ""}) {
    evidence.data_quality.flags = {flag};
    const Verdict verdict = decide(evidence, {}, {}, &combined);
    ASSERT_EQ(verdict.code, Code::nonlinear_unexplained);
    EXPECT_THAT(verdict.action, HasSubstr(*flag != 0 ? "(op)" : "(mv)"));
  }
}

TEST(Decide, CausesComeTheMostProbableFirst) {
  const Verdict verdict = decide(quiet_evidence(), {});
  EXPECT_GE(verdict.causes.size(), 13U);
  for (std::size_t k = 1; k < verdict.causes.size(); ++k)
    EXPECT_GE(verdict.causes[k - 1].probability, verdict.causes[k].probability);
}

/// A site that expects next to nothing else.
DecisionSettings expecting_disturbances() {
  DecisionSettings decision;
  decision.priors.external_disturbance = 0.99;
  return decision;
}

TEST(Decide, PlainSentencesStandFirstThenPartsForAndAgainst) {
  model::Step step = clear_step(model::EffectKind::load_step);
  step.statement = "The load moved.";
  const Evidence evidence = evidence_with(explanation_of({step}));
  const Verdict verdict = decide(evidence, {}, expecting_disturbances());
  EXPECT_EQ(verdict.code, Code::external_disturbance);
  const auto plain =
      static_cast<std::ptrdiff_t>(plain_evidence(Code::external_disturbance, evidence).size());
  ASSERT_GT(plain, 0);
  for (auto reason = verdict.reasons.begin(); reason != verdict.reasons.begin() + plain; ++reason)
    EXPECT_THAT(*reason, Not(HasSubstr("odds")));
  EXPECT_EQ(verdict.reasons.at(static_cast<std::size_t>(plain)), kFiguresFollow);
  EXPECT_THAT(verdict.reasons.at(static_cast<std::size_t>(plain) + 1),
              AllOf(HasSubstr("For: "), HasSubstr("(odds times ")));
  EXPECT_THAT(verdict.reasons,
              Contains(HasSubstr("One-step prediction error on held-out samples: 1 -> 0.5")));
}

TEST(Decide, TuningWaitsForAValve) {
  Evidence evidence =
      evidence_with(explanation_of({clear_step(model::EffectKind::valve_stiction)}));
  evidence.shape.mv_op_width = 3.0;
  evidence.shape.mv_slip_jump = 2.0;
  evidence.shape.mv_stuck_fraction = 0.9;
  const Verdict verdict = decide(evidence, {});
  EXPECT_EQ(verdict.code, Code::valve_stiction);
  EXPECT_THAT(verdict.action, HasSubstr("Do not retune"));
}

TEST(Decide, NothingIsEverCalledLinear) {
  for (const std::string& reason : decide(quiet_evidence(), {}).reasons)
    EXPECT_THAT(reason, testing::Not(HasSubstr(" linear")));
}

TEST(Decide, ShortAndChangingRecordsSaySoAtTheEnd) {
  Evidence evidence = quiet_evidence();
  evidence.data_quality.flags = {"short"};
  EXPECT_EQ(decide(evidence, {}).reasons.back(), "Short record: fewer than 32 segments.");
  evidence.data_quality.stretch = "samples 1 to 900 of 4096";
  EXPECT_EQ(decide(evidence, {}).reasons.back(),
            "The loop changed within the window: the tests use only samples 1 to 900 of 4096.");
}

TEST(Decide, SeveralWindowsSayWhatTheNewestAloneWouldGive) {
  Evidence evidence = quiet_evidence();
  evidence.hos->nonlinear_p = 1e-9;
  const CombinedOdds combined = nothing_but_nonlinear();
  EXPECT_THAT(decide(evidence, {}, {}, &combined).reasons,
              Contains(testing::MatchesRegex("Judged by several windows together; by the newest "
                                             "alone this finding would be [0-9]+ % probable.")));
}

}  // namespace
}  // namespace loopscope::core::diagnosis
