#include "core/model/residual_tests/statistics/centred.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace loopscope::core::model {
namespace {

const double kMissing = std::numeric_limits<double>::quiet_NaN();
const double kInfinite = std::numeric_limits<double>::infinity();

TEST(Centred, MissingSamplesAreZeroAndDoNotCount) {
  const auto signal = centred(std::vector{1.0, kMissing, 3.0, kInfinite}, 2);
  ASSERT_TRUE(signal);
  EXPECT_EQ(signal->values, (std::vector{-1.0, 0.0, 1.0, 0.0}));
  EXPECT_EQ(signal->mean, 2.0);
  EXPECT_EQ(signal->std, 1.0);
  EXPECT_EQ(signal->recorded, 2U);
}

TEST(Centred, ConstantShortAndEmptySignalsAreNone) {
  EXPECT_FALSE(centred(std::vector{2.0, 2.0, 2.0}, 2));
  EXPECT_FALSE(centred(std::vector{1.0, 2.0}, 3));
  EXPECT_FALSE(centred({}, 0));
}

TEST(Centred, HighPassedIsWhatThePastDidNotForetell) {
  const std::vector<double> step = high_passed(std::vector{5.0, 5.0, 6.0, 6.0, kMissing, 6.0});
  EXPECT_EQ(step[0], 0.0);
  EXPECT_EQ(step[1], 0.0);
  EXPECT_EQ(step[2], 1.0);
  EXPECT_NEAR(step[3], 1.0 - 1.0 / kMemorySamples, 1e-12);
  EXPECT_TRUE(std::isnan(step[4]));
  EXPECT_NEAR(step[5], step[3] * step[3], 1e-12);
}

TEST(Centred, IncrementsOfAGapAreMissing) {
  const std::vector<double> moves = increments(std::vector{1.0, 3.0, kMissing, 4.0});
  EXPECT_TRUE(std::isnan(moves[0]) && std::isnan(moves[2]) && std::isnan(moves[3]));
  EXPECT_EQ(moves[1], 2.0);
}

TEST(Centred, SortsWhatIsFinite) {
  EXPECT_EQ(sorted_finite(std::vector{3.0, kMissing, 1.0, kInfinite}), (std::vector{1.0, 3.0}));
}

}  // namespace
}  // namespace loopscope::core::model
