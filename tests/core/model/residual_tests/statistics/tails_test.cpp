#include "core/model/residual_tests/statistics/tails.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::core::model {
namespace {

TEST(Tails, ChiSquareHasItsClosedForms) {
  EXPECT_NEAR(chi_square_p(3.841458821, 1), 0.05, 1e-9);
  EXPECT_DOUBLE_EQ(chi_square_p(7.0, 2), std::exp(-3.5));
  EXPECT_NEAR(chi_square_p(7.0, 4), std::exp(-3.5) * (1.0 + 3.5), 1e-15);
  EXPECT_NEAR(chi_square_p(7.814727903, 3), 0.05, 1e-9);
  EXPECT_NEAR(chi_square_p(37.65248413, 25), 0.05, 1e-9);
  EXPECT_EQ(chi_square_p(0.0, 5), 1.0);
  EXPECT_GT(chi_square_p(1e6, 5), 0.0);
}

TEST(Tails, BridgeIsKolmogorovs) {
  EXPECT_NEAR(bridge_upper(1.3581), 0.05, 1e-5);
  EXPECT_NEAR(bridge_upper(1.6276), 0.01, 1e-5);
  EXPECT_NEAR(bridge_upper(0.31), 1.0, 1e-4);
  EXPECT_EQ(bridge_upper(0.0), 1.0);
}

TEST(Tails, LargestShareIsFishers) {
  // Two exponentials: the larger share is uniform on 1/2 to 1.
  EXPECT_NEAR(largest_share_upper(0.9, 2), 0.2, 1e-12);
  EXPECT_NEAR(largest_share_upper(0.198, 50), 50.0 * std::pow(0.802, 49.0), 1e-15);
  EXPECT_EQ(largest_share_upper(0.0, 50), 1.0);
}

}  // namespace
}  // namespace loopscope::core::model
