#include "core/hos/coupling/combine_p.hpp"

#include <array>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/uniformity.hpp"
#include "tests/support/chance.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

TEST(HosCombineP, OfOneIsItself) {
  for (const double p : {1e-300, 1e-9, 0.99e-8, 1.01e-8, 0.04, 0.5, 0.89}) {
    EXPECT_NEAR(combine_p(std::array{p}) / p, 1.0, 1e-7) << p;
  }
}

TEST(HosCombineP, OfEqualOnesIsThatOne) {
  for (const double p : {1e-20, 1e-3, 0.3}) {
    EXPECT_NEAR(combine_p(std::array{p, p, p}) / p, 1.0, 1e-8) << p;
  }
}

TEST(HosCombineP, OfIndependentOnesHoldsEveryLevel) {
  const int draws = tests::records(1'000'000);
  for (const std::size_t count : {2U, 3U}) {
    std::mt19937_64 generator(count);
    std::vector<double> combined;
    for (int draw = 0; draw < draws; ++draw) {
      std::vector<double> p(count);
      for (double& value : p) value = (static_cast<double>(generator() >> 11U) + 0.5) * 0x1p-53;
      combined.push_back(combine_p(p));
    }
    for (const double level : {0.05, 0.01, 1e-3, 1e-4}) {
      // Holding p at 0.9 raises the rate at middling levels, by a twentieth at 5 %.
      const double rate = tests::share_below(combined, level);
      EXPECT_GE(rate, level - four_errors(level, draws)) << level;
      EXPECT_LE(rate, 1.05 * level + four_errors(level, draws)) << level;
    }
  }
}

TEST(HosCombineP, OneTinyPAmongNCountsNTimes) {
  EXPECT_NEAR(combine_p(std::array{1e-12, 0.5, 0.5}) / 3e-12, 1.0, 1e-6);
  EXPECT_NEAR(combine_p(std::array{0.5, 1e-100}) / 2e-100, 1.0, 1e-6);
}

TEST(HosCombineP, OneThatFitsTooWellHidesNothing) {
  EXPECT_LT(combine_p(std::array{0.001, 1.0}), 0.003);
  EXPECT_DOUBLE_EQ(combine_p(std::array{0.001, 1.0}), combine_p(std::array{0.001, 0.9}));
}

TEST(HosCombineP, SeveralMiddlingOnesAddUp) {
  EXPECT_LT(combine_p(std::array{0.02, 0.02, 0.02}), 3.0 * 0.02 / 2.0);
}

TEST(HosCombineP, RisesWithEachP) {
  double before = 0.0;
  for (double p = 1e-300; p <= 1.0; p *= 1.1) {
    const double combined = combine_p(std::array{p, 0.2});
    // The two branches meet within rounding of the tangent, about 1e-8.
    EXPECT_GE(combined * (1.0 + 1e-7), before) << p;
    before = combined;
  }
}

TEST(HosCombineP, StaysBetweenZeroAndOne) {
  for (const double a : {1e-308, 1e-300, 1e-8, 0.5, 1.0}) {
    for (const double b : {1e-308, 1e-300, 1e-8, 0.5, 1.0}) {
      const double combined = combine_p(std::array{a, b, b});
      EXPECT_GT(combined, 0.0);
      EXPECT_LE(combined, 1.0);
    }
  }
}

}  // namespace
}  // namespace loopscope::core::hos
