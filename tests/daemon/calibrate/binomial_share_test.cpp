#include "daemon/calibrate/binomial_share.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

namespace loopscope::daemon {
namespace {

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
