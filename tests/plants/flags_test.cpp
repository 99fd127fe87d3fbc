#include "tests/plants/flags.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::tests::plants {
namespace {

using testing::ElementsAre;
using testing::Pair;

constexpr FlagRule kAtFivePercent{0.05, 0.3, 0.05};

DiagnosedLoop healthy() {
  return {"healthy", 0.9, {}, 5, {}};
}

DiagnosedLoop faulty(std::optional<double> p, double confidence = 0.8) {
  return {"valve_stiction", confidence, p, 5, {}};
}

TEST(Flags, SmallProbabilitiesFactsAndNothingElse) {
  // A family of 25 tests; the first p has to be at most 0.05 / 25.
  EXPECT_THAT(flagged({healthy(), faulty(1e-3), faulty(0.01), faulty(std::nullopt), healthy()},
                      kAtFivePercent),
              ElementsAre(false, true, false, true, false));
}

TEST(Flags, WhatIsHardlyBelievedLendsNoRank) {
  EXPECT_THAT(flagged({faulty(1e-9, 0.29), faulty(1e-9, 0.3)}, kAtFivePercent),
              ElementsAre(false, true));
  EXPECT_THAT(flagged({faulty(1e-9), faulty(0.0095)}, kAtFivePercent), ElementsAre(true, true));
  EXPECT_THAT(flagged({faulty(1e-9, 0.29), faulty(0.0095)}, kAtFivePercent),
              ElementsAre(false, false));
}

TEST(Flags, WhereFaultsWereWeighedTheyHaveToBeProbableAsWell) {
  const auto weighed = [](double fault_probability, std::optional<double> p) {
    DiagnosedLoop loop = faulty(p);
    loop.fault_probability = fault_probability;
    return loop;
  };
  constexpr FlagRule kHalf{0.05, 0.3, 0.05};
  EXPECT_THAT(flagged({weighed(0.99, 1e-9), weighed(0.92, std::nullopt), weighed(0.8, 1e-9),
                       weighed(0.99, 0.5), healthy()},
                      kHalf),
              ElementsAre(true, true, false, false, false));
  constexpr FlagRule kByOddsAlone{1.0, 0.3, 0.05};
  EXPECT_THAT(flagged({weighed(0.99, 0.9), healthy(), healthy(), healthy()}, kByOddsAlone),
              ElementsAre(true, false, false, false));
}

TEST(Flags, DataThatCannotBeJudgedAreNoFault) {
  EXPECT_THAT(flagged({{"insufficient_data", 1.0, {}, 0, {}}}), ElementsAre(false));
}

TEST(Flags, CarryTheVerdict) {
  const std::vector<PlantLoop> plant = draw_plant(1, {2, 0});
  EXPECT_THAT(flags_of(plant, {healthy(), faulty(1e-9)}),
              ElementsAre(Pair("L002", "valve_stiction")));
}

}  // namespace
}  // namespace loopscope::tests::plants
