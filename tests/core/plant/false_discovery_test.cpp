#include "core/plant/false_discovery.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <random>
#include <stdexcept>
#include <tuple>

namespace loopscope::core::plant {
namespace {

using testing::Each;
using testing::ElementsAre;
using Random = std::mt19937_64;

constexpr double kNotTested = std::numeric_limits<double>::quiet_NaN();

TEST(FalseDiscovery, ReproducesTheExampleOfBenjaminiAndHochberg) {
  // Their section 3.2: fifteen p-values, of which the control at 0.05 rejects four (Bonferroni's
  // method three).
  const std::vector<double> p{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                              0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};
  const FalseDiscovery result = control_false_discovery(p, 0.05);
  EXPECT_EQ(result.threshold, 0.0095);
  EXPECT_EQ(std::ranges::count(result.flagged, true), 4);
}

TEST(FalseDiscovery, FlagsKeepTheOrderOfTheTests) {
  EXPECT_THAT(control_false_discovery(std::vector{0.9, 1e-4, 0.5, 2e-4}, 0.05).flagged,
              ElementsAre(false, true, false, true));
}

TEST(FalseDiscovery, TestsThatWereNotMadeDoNotCount) {
  // 0.04 passes alone and not beside another test.
  EXPECT_THAT(control_false_discovery(std::vector{kNotTested, 0.04, kNotTested}, 0.05).flagged,
              ElementsAre(false, true, false));
  EXPECT_THAT(control_false_discovery(std::vector{1.0, 0.04}, 0.05).flagged, Each(false));
  EXPECT_THAT(control_false_discovery(std::vector{kNotTested, kNotTested}, 0.05).flagged,
              Each(false));
}

TEST(FalseDiscovery, WithoutAFlagThereIsNoThreshold) {
  EXPECT_TRUE(std::isnan(control_false_discovery(std::vector{0.5, 0.9}, 0.05).threshold));
  EXPECT_TRUE(std::isnan(control_false_discovery(std::vector<double>{}, 0.05).threshold));
  EXPECT_TRUE(control_false_discovery(std::vector<double>{}, 0.05).flagged.empty());
}

TEST(FalseDiscovery, TiesStandOrFallTogether) {
  EXPECT_THAT(control_false_discovery(std::vector{0.025, 0.025, 1.0, 1.0}, 0.05).flagged,
              ElementsAre(true, true, false, false));
  EXPECT_THAT(control_false_discovery(std::vector{0.026, 0.026, 1.0, 1.0}, 0.05).flagged,
              Each(false));
}

TEST(FalseDiscovery, ZeroIsFlaggedAtEveryRateAndOneOnlyAtOne) {
  const std::vector<double> p{0.0, 1.0};
  EXPECT_THAT(control_false_discovery(p, 0.0).flagged, ElementsAre(true, false));
  EXPECT_THAT(control_false_discovery(p, 1.0).flagged, ElementsAre(true, true));
}

TEST(FalseDiscovery, ArbitraryDependenceDividesByTheHarmonicSum) {
  // m = 4: c = 25 / 12, so that the bound of the smallest is 0.05 / 4 / (25 / 12) = 0.006.
  for (const auto& [p, flagged] : {std::pair{0.0059, true}, std::pair{0.0061, false}}) {
    const std::vector<double> tests{p, 1.0, 1.0, 1.0};
    EXPECT_EQ(control_false_discovery(tests, 0.05, Dependence::arbitrary).flagged[0], flagged) << p;
    EXPECT_TRUE(control_false_discovery(tests, 0.05).flagged[0]);
  }
}

TEST(FalseDiscovery, RefusesWhatIsNoProbability) {
  for (const double bad : {-1e-9, 1.0 + 1e-9, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(std::ignore = control_false_discovery(std::vector{bad}, 0.05),
                 std::invalid_argument);
    EXPECT_THROW(std::ignore = control_false_discovery(std::vector{0.5}, bad),
                 std::invalid_argument);
  }
  EXPECT_THROW(std::ignore = control_false_discovery(std::vector{0.5}, kNotTested),
               std::invalid_argument);
}

double upper_tail(double deviate) {
  return 0.5 * std::erfc(deviate / std::sqrt(2.0));
}

/// Mean false share over plants of 500 tests, `faulty` of them real (deviates of mean 4), all
/// deviates of a plant sharing a common part.
double mean_false_share(Dependence dependence, std::size_t faulty, double shared) {
  constexpr int kPlants = 4000;
  std::normal_distribution<double> normal;
  double sum = 0.0;
  for (int seed = 1; seed <= kPlants; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const double common = normal(random);
    std::vector<double> p(500);
    for (std::size_t k = 0; k < p.size(); ++k) {
      const double noise = std::sqrt(shared) * common + std::sqrt(1.0 - shared) * normal(random);
      p[k] = upper_tail((k < faulty ? 4.0 : 0.0) + noise);
    }
    const std::vector<bool> flagged = control_false_discovery(p, 0.05, dependence).flagged;
    const auto flags = static_cast<double>(std::ranges::count(flagged, true));
    const auto wrong = static_cast<double>(
        std::count(flagged.begin() + static_cast<std::ptrdiff_t>(faulty), flagged.end(), true));
    sum += flags > 0.0 ? wrong / flags : 0.0;
  }
  return sum / kPlants;
}

TEST(FalseDiscovery, FalseShareIsTheRateTimesTheShareOfTrueNulls) {
  // Exactly so for independent tests; a plant's share scatters by at most 0.22, the mean of 4000 by
  // 0.0035.
  for (const std::size_t faulty : {std::size_t{0}, std::size_t{10}, std::size_t{100}}) {
    const double expected = 0.05 * (1.0 - static_cast<double>(faulty) / 500.0);
    EXPECT_NEAR(mean_false_share(Dependence::positive, faulty, 0.0), expected, 0.011) << faulty;
  }
}

TEST(FalseDiscovery, SharedNoiseDoesNotRaiseIt) {
  for (const double shared : {0.3, 0.7}) {
    EXPECT_LE(mean_false_share(Dependence::positive, 10, shared), 0.05) << shared;
    EXPECT_LE(mean_false_share(Dependence::arbitrary, 10, shared), 0.02) << shared;
  }
}

}  // namespace
}  // namespace loopscope::core::plant
