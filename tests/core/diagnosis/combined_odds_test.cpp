#include "core/diagnosis/combined_odds.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

namespace loopscope::core::diagnosis {
namespace {

constexpr double kWindow_s = 1000.0;

JudgedWindow window_at(double end_s, double probability, bool with_model = true) {
  return {end_s - kWindow_s, end_s, with_model, {std::nullopt, probability}};
}

const PerCause kPriors = {0.2, 0.15};

double probability(const CombinedOdds& combined) {
  return combined.probabilities.at(1).value();
}

/// `count` windows of the same probability that share no sample.
CombinedOdds after(int count, double own, bool with_model = true) {
  std::optional<CombinedOdds> combined;
  for (int k = 1; k <= count; ++k)
    combined = combine(combined, window_at(k * kWindow_s, own, with_model), kPriors);
  return *combined;
}

TEST(CombinedOdds, OneWindowIsItself) {
  for (const bool with_model : {true, false}) {
    const CombinedOdds one = after(1, 0.7, with_model);
    EXPECT_NEAR(probability(one), 0.7, 1e-12);
    EXPECT_FALSE(one.probabilities.at(0)) << "what was not weighed stays unknown";
  }
}

TEST(CombinedOdds, AgreeingWindowsSayMoreThanOneAndLessThanIndependentOnes) {
  const double independent = 3.0 * (log_odds_of(0.7) - log_odds_of(0.15)) + log_odds_of(0.15);
  EXPECT_GT(probability(after(3, 0.7)), 0.7);
  EXPECT_LT(log_odds_of(probability(after(3, 0.7))), independent);
  EXPECT_LT(probability(after(3, 0.05)), 0.05) << "against a cause as well";
}

TEST(CombinedOdds, WindowsThatSayNothingKeepThePrior) {
  EXPECT_NEAR(probability(after(5, 0.15)), 0.15, 1e-9);
}

TEST(CombinedOdds, AWindowCountsByItsNewSamples) {
  const CombinedOdds first = after(1, 0.3);
  const double much = probability(combine(first, window_at(2.0 * kWindow_s, 0.9), kPriors));
  const double little = probability(combine(first, window_at(1.05 * kWindow_s, 0.9), kPriors));
  EXPECT_GT(much, little);
  EXPECT_NEAR(little, 0.3, 0.1);
}

TEST(CombinedOdds, WithoutAModelAWindowLeavesTheModelsEvidenceStanding) {
  const CombinedOdds first = after(2, 0.9);
  const auto next = [&](bool with_model) {
    return probability(combine(first, window_at(3.0 * kWindow_s, 0.15, with_model), kPriors));
  };
  EXPECT_GT(next(false), next(true));
}

TEST(CombinedOdds, WhatIsOldIsForgotten) {
  const CombinedOdds first = after(6, 0.95);
  CombinedOdds now = first;
  for (int k = 7; k <= 7 + 12; ++k) now = combine(now, window_at(k * kWindow_s, 0.02), kPriors);
  EXPECT_LT(probability(now), 0.05);
  const double later = first.end_s + longest_memory_windows() * kWindow_s;
  EXPECT_NEAR(probability(combine(first, window_at(later, 0.4), kPriors)), 0.4, 1e-12);
}

TEST(CombinedOdds, TheLastStepHoldsAllThatCameBefore) {
  // As storage keeps it: in four bytes.
  CombinedOdds kept = after(4, 0.8);
  kept.probabilities[1] = static_cast<double>(static_cast<float>(*kept.probabilities[1]));
  kept.windows = static_cast<double>(static_cast<float>(kept.windows));
  EXPECT_NEAR(probability(combine(kept, window_at(5.0 * kWindow_s, 0.8), kPriors)),
              probability(after(5, 0.8)), 1e-6);
}

TEST(CombinedOdds, AShiftedPriorCountsOnce) {
  const double shift = std::log(3.0);
  const auto shifted = [&](double p) { return 1.0 / (1.0 + std::exp(-log_odds_of(p) - shift)); };
  const PerCause priors = {0.2, shifted(0.15)};
  std::optional<CombinedOdds> combined;
  for (int k = 1; k <= 5; ++k)
    combined = combine(combined, window_at(k * kWindow_s, shifted(0.6)), priors);
  EXPECT_NEAR(probability(*combined), shifted(probability(after(5, 0.6))), 1e-9);
}

TEST(CombinedOdds, WindowsComeByAscendingEnds) {
  EXPECT_THROW((void)combine(after(2, 0.5), window_at(2.0 * kWindow_s, 0.5), kPriors),
               std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::diagnosis
