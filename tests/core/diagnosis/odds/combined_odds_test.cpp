#include "core/diagnosis/odds/combined_odds.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "core/diagnosis/odds/log_odds.hpp"

namespace loopscope::core::diagnosis {
namespace {

constexpr double kWindow_s = 1000.0;

/// A cause that stands alone, so that nothing but its own windows counts.
constexpr auto kCause = static_cast<std::size_t>(VerdictCode::nonlinear_unexplained);

double share(std::size_t cause = kCause) {
  return *shares_of_causes().at(cause);
}

PerCause only(std::size_t cause, double value) {
  PerCause values;
  set_cause(values, static_cast<VerdictCode>(cause), value);
  return values;
}

JudgedWindow window_at(double end_s, double probability, bool with_model = true) {
  return {end_s - kWindow_s, end_s, with_model,
          only(kCause, log_odds_of(probability) - log_odds_of(share()))};
}

JudgedWindow without_op(double end_s) {
  return {end_s - kWindow_s, end_s, true, {0.5}};
}

double probability(const CombinedOdds& combined, const PerCause& priors = {}) {
  return probabilities_of(combined, priors).at(kCause).value();
}

/// `count` windows of the same probability that share no sample.
CombinedOdds after(int count, double own, bool with_model = true) {
  std::optional<CombinedOdds> combined;
  for (int k = 1; k <= count; ++k)
    combined = combine(combined, window_at(k * kWindow_s, own, with_model));
  return *combined;
}

TEST(CombinedOdds, OneWindowIsItself) {
  for (const bool with_model : {true, false}) {
    const CombinedOdds one = after(1, 0.7, with_model);
    EXPECT_NEAR(probability(one), 0.7, 1e-12);
    EXPECT_FALSE(probabilities_of(one, {}).at(0)) << "what was not weighed stays unknown";
  }
}

/// Windows of one loop err together.
TEST(CombinedOdds, AgreeingWindowsAreAsSureAsOneOfThem) {
  for (const double own : {0.05, 0.7}) EXPECT_NEAR(probability(after(3, own)), own, 1e-12);
}

TEST(CombinedOdds, WindowsThatSayNothingKeepThePrior) {
  EXPECT_NEAR(probability(after(5, share())), share(), 1e-9);
}

TEST(CombinedOdds, AWindowCountsByItsNewSamples) {
  const CombinedOdds first = after(1, 0.3);
  const double much = probability(combine(first, window_at(2.0 * kWindow_s, 0.9)));
  const double little = probability(combine(first, window_at(1.05 * kWindow_s, 0.9)));
  EXPECT_GT(much, little);
  EXPECT_NEAR(little, 0.3, 0.1);
}

TEST(CombinedOdds, WithoutAModelAWindowLeavesTheModelsEvidenceStanding) {
  const CombinedOdds first = after(2, 0.9);
  const auto next = [&](bool with_model) {
    return probability(combine(first, window_at(3.0 * kWindow_s, 0.15, with_model)));
  };
  EXPECT_GT(next(false), next(true));
}

TEST(CombinedOdds, WhatIsOldIsForgotten) {
  const CombinedOdds first = after(6, 0.95);
  CombinedOdds now = first;
  for (int k = 7; k <= 7 + 12; ++k) now = combine(now, window_at(k * kWindow_s, 0.02));
  EXPECT_LT(probability(now), 0.05);
  const double later = first.end_s + longest_memory_windows() * kWindow_s;
  EXPECT_NEAR(probability(combine(first, window_at(later, 0.4))), 0.4, 1e-12);
}

TEST(CombinedOdds, TheLastStepHoldsAllThatCameBefore) {
  // As storage keeps it: in four bytes.
  CombinedOdds kept = after(4, 0.8);
  kept.evidence[kCause] = static_cast<double>(static_cast<float>(*kept.evidence[kCause]));
  kept.windows[kCause] = static_cast<double>(static_cast<float>(*kept.windows[kCause]));
  EXPECT_NEAR(probability(combine(kept, window_at(5.0 * kWindow_s, 0.8))),
              probability(after(5, 0.8)), 1e-6);
}

TEST(CombinedOdds, APriorCountsOnceWheneverItIsSet) {
  const double shift = std::log(3.0);
  const auto shifted = [&](double p) { return 1.0 / (1.0 + std::exp(-log_odds_of(p) - shift)); };
  EXPECT_NEAR(probability(after(5, 0.6), only(kCause, shifted(share()))),
              shifted(probability(after(5, 0.6))), 1e-9);
}

TEST(CombinedOdds, WhatOpNoLongerShowsFades) {
  CombinedOdds now = after(3, 0.9);
  const double known = probability(now);
  now = combine(now, without_op(4.0 * kWindow_s));
  EXPECT_LT(probability(now), known);
  EXPECT_GT(probability(now), 0.5);
  for (int k = 5; k <= 30; ++k) now = combine(now, without_op(k * kWindow_s));
  EXPECT_NEAR(probability(now), share(), 0.01);
  now = combine(now, window_at(31.0 * kWindow_s, 0.02));
  EXPECT_NEAR(probability(now), 0.02, 0.002) << "and no longer weighs against what is new";
}

TEST(CombinedOdds, ACauseThatIsWeighedLateIsItselfAtFirst) {
  CombinedOdds now = combine(std::nullopt, without_op(kWindow_s));
  for (int k = 2; k <= 6; ++k) now = combine(now, without_op(k * kWindow_s));
  EXPECT_NEAR(probability(combine(now, window_at(7.0 * kWindow_s, 0.7))), 0.7, 1e-9);
}

TEST(CombinedOdds, VerySureWindowsKeepTheirMean) {
  const CombinedOdds sure = after(8, 0.9999);
  EXPECT_NEAR(*sure.evidence[kCause], log_odds_of(0.9999) - log_odds_of(share()), 1e-9);
}

/// Counted after all windows, so that what others take away does not grow from window to window.
TEST(CombinedOdds, OthersCountOnce) {
  const auto sticking = [](double wave, int count) {
    std::optional<CombinedOdds> combined;
    for (int k = 1; k <= count; ++k) {
      PerCause evidence = only(static_cast<std::size_t>(VerdictCode::valve_stiction), 2.0);
      set_cause(evidence, VerdictCode::external_disturbance, wave);
      combined = combine(combined, {(k - 1) * kWindow_s, k * kWindow_s, true, evidence});
    }
    return log_odds_of(probabilities_of(*combined, {}).at(1).value());
  };
  EXPECT_LT(sticking(2.0, 1), sticking(-2.0, 1));
  const double after_one = sticking(-2.0, 1) - sticking(2.0, 1);
  EXPECT_NEAR(sticking(-2.0, 8) - sticking(2.0, 8), after_one, 1e-9);
}

TEST(CombinedOdds, AWindowStandsAloneUntilAnotherCounts) {
  EXPECT_TRUE(stands_alone(std::nullopt, window_at(kWindow_s, 0.5)));
  const CombinedOdds first = after(1, 0.5);
  EXPECT_FALSE(stands_alone(first, window_at(2.0 * kWindow_s, 0.5)));
  const double later = first.end_s + longest_memory_windows() * kWindow_s;
  EXPECT_TRUE(stands_alone(first, window_at(later, 0.5)));
}

/// What was not weighed is as much of a rival as what says nothing.
TEST(CombinedOdds, MissingCausesAreAsProbableAsAnywhere) {
  PerCause evidence = only(static_cast<std::size_t>(VerdictCode::external_disturbance), 1.0);
  const JudgedWindow few{0.0, kWindow_s, true, evidence};
  set_cause(evidence, VerdictCode::valve_stiction, 0.0);
  const JudgedWindow more{0.0, kWindow_s, true, evidence};
  const auto place = static_cast<std::size_t>(VerdictCode::external_disturbance);
  const PerCause without = probabilities_of(combine(std::nullopt, few), {});
  EXPECT_FALSE(without.at(1));
  EXPECT_NEAR(*without.at(place), *probabilities_of(combine(std::nullopt, more), {}).at(place),
              1e-12);
}

/// A prior is the plant's, and moves a cause that stands beside others by as much as one alone.
TEST(CombinedOdds, APriorCountsOnceBesideOthers) {
  const CombinedOdds combined = combine(std::nullopt, {0.0, kWindow_s, true, only(1, 1.0)});
  const double shift = 0.7;
  const double moved = 1.0 / (1.0 + std::exp(-log_odds_of(share(1)) - shift));
  EXPECT_NEAR(log_odds_of(*probabilities_of(combined, only(1, moved)).at(1)),
              log_odds_of(*probabilities_of(combined, {}).at(1)) + shift, 1e-9);
}

TEST(CombinedOdds, EvidenceIsOfItsOwnFigures) {
  Verdict verdict;
  verdict.causes = {{VerdictCode::valve_stiction, 0.6, 0.5, {}, {}, 1.25},
                    {VerdictCode::healthy, 0.1, 0.3, {}, {}, -400.0}};
  const PerCause evidence = evidence_of(verdict);
  EXPECT_NEAR(*evidence.at(1), 1.25, 1e-9);
  EXPECT_NEAR(*evidence.at(0), log_odds_of(0.0) - log_odds_of(share(0)), 1e-9);
}

TEST(CombinedOdds, TheTableHoldsEveryCauseThatHasCurves) {
  const PerCause& shares = shares_of_causes();
  EXPECT_EQ(fitted_windows().size(), shares.size());
  for (const auto& [code, fitted] : fitted_windows()) {
    EXPECT_TRUE(shares.at(static_cast<std::size_t>(code))) << fitted.cause;
  }
}

TEST(CombinedOdds, WindowsComeByAscendingEnds) {
  EXPECT_THROW((void)combine(after(2, 0.5), window_at(2.0 * kWindow_s, 0.5)),
               std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
