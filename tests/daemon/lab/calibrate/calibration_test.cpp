#include "daemon/lab/calibrate/calibration.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

#include "daemon/lab/calibrate/calibration_json.hpp"
#include "daemon/lab/calibrate/calibration_text.hpp"

namespace loopscope::daemon {
namespace {

using core::simulate::CalibrationFamily;
using core::simulate::FamilyKind;
using testing::HasSubstr;

std::vector<CalibrationFamily> few_families() {
  std::vector<CalibrationFamily> chosen;
  std::ranges::copy_if(core::simulate::calibration_families(), std::back_inserter(chosen),
                       [](const CalibrationFamily& family) {
                         return family.name == "white" || family.name == "white_exponential" ||
                                family.name == "sawtooth_30";
                       });
  return chosen;
}

void nothing() {}

Calibration measured(std::size_t records, std::size_t threads) {
  return {records, tally_families(few_families(), records, threads, nothing), {}};
}

TEST(Calibration, CountsDoNotDependOnTheThreads) {
  auto one = calibration_json(measured(20, 1));
  auto four = calibration_json(measured(20, 4));
  one.erase("cost");
  four.erase("cost");
  EXPECT_EQ(one, four);
}

TEST(Calibration, EveryRecordIsCountedAndAnnounced) {
  std::atomic<int> done = 0;
  const auto tallies = tally_families(few_families(), 7, 2, [&done] { ++done; });
  EXPECT_EQ(done, 21);
  for (const FamilyTally& tally : tallies) {
    EXPECT_EQ(tally.tests[0].computed, 7U) << tally.family.name;
    EXPECT_GE(tally.tests[0].rejected[0], tally.tests[0].rejected[1]) << tally.family.name;
    EXPECT_GT(tally.analyse_s, 0.0);
  }
}

TEST(Calibration, CoupledSignalsAreRejectedAndWhiteOnesMostlyNot) {
  const auto json = calibration_json(measured(60, 2));
  const auto share = [&json](std::size_t family, const char* test) {
    return json["families"][family]["rejected"][test]["at_0.05"]["share"].get<double>();
  };
  EXPECT_LT(share(0, "hinich_gaussianity"), 0.2);  // nominal 0.05, over four standard errors
  EXPECT_EQ(share(1, "hinich_gaussianity"), 1.0);
  EXPECT_EQ(share(2, "published_rule"), 1.0);
}

TEST(Calibration, WhatWasNotComputedIsNull) {
  Calibration calibration = measured(2, 1);
  for (FamilyTally& tally : calibration.families) tally.tests[kRecordTests - 1] = {};
  const auto json = calibration_json(calibration);
  EXPECT_TRUE(json["families"][0]["rejected"]["nonlinear_p"].is_null());
  EXPECT_THAT(calibration_text(calibration), HasSubstr(" - \n"));
}

TEST(Calibration, JsonHasItsKeys) {
  const auto json = calibration_json(measured(3, 1));
  EXPECT_EQ(json["records"], 3);
  EXPECT_EQ(json["tests"].size(), kRecordTests);
  EXPECT_EQ(json["families"].size(), 3U);
  EXPECT_EQ(json["families"][1]["kind"], "linear_non_gaussian");
  EXPECT_EQ(json["families"][0]["samples"], 4096);
  const auto& limits = json["families"][0]["rejected"]["published_ngi"]["at_0.01"];
  EXPECT_LE(limits["low"], limits["share"]);
  EXPECT_GE(limits["high"], limits["share"]);
  EXPECT_GT(json["cost"]["ratio"], 0.5);
  EXPECT_EQ(json["cost"]["ratio_by_family"].size(), 3U);
  EXPECT_TRUE(json["plants"].empty());
}

TEST(Calibration, TextMarksWhatIsRejectedTooOften) {
  Calibration calibration = measured(1, 1);
  calibration.records = 100;
  for (FamilyTally& tally : calibration.families) tally.tests[0] = {100, {20, 0}};
  const std::string text = calibration_text(calibration);
  EXPECT_THAT(text, HasSubstr("20.0 (13-29)*"));  // white
  EXPECT_THAT(text, HasSubstr("20.0 (13-29) "));  // sawtooth: power, not an error
  EXPECT_THAT(text, HasSubstr("nominal 5 %"));
  EXPECT_THAT(text, HasSubstr("nominal 1 %"));
  EXPECT_THAT(text, HasSubstr("CPU time"));
}

TEST(BinomialShare, LimitsAreThoseOfClopperAndPearson) {
  // None of n: the upper limit p solves (1 - p)^n = 0.025.
  const BinomialShare none = binomial_share(0, 10);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 1.0 - std::pow(0.025, 0.1), 1e-9);
  // One of two: at least one has probability 0.025 at the lower limit, 1 - (1 - low)^2 = 0.025.
  const BinomialShare half = binomial_share(1, 2);
  EXPECT_DOUBLE_EQ(half.share, 0.5);
  EXPECT_NEAR(half.low, 1.0 - std::sqrt(0.975), 1e-9);
  EXPECT_NEAR(half.high, std::sqrt(0.975), 1e-9);
  const BinomialShare all = binomial_share(10, 10);
  EXPECT_NEAR(all.low, std::pow(0.025, 0.1), 1e-9);
  EXPECT_EQ(all.high, 1.0);
}

TEST(BinomialShare, MoreTrialsSayMore) {
  const BinomialShare few = binomial_share(5, 100);
  const BinomialShare many = binomial_share(500, 10'000);
  EXPECT_LT(many.high - many.low, 0.2 * (few.high - few.low));
}

TEST(BinomialShare, RefusesImpossibleCounts) {
  EXPECT_THROW((void)binomial_share(0, 0), std::invalid_argument);
  EXPECT_THROW((void)binomial_share(3, 2), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::daemon
