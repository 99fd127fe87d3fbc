#include "core/model/controller/polynomial_zeros.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::core::model {
namespace {

TEST(PolynomialZeros, OfAKnownPolynomial) {
  // (1 - 0.5 z^-1)(1 + 0.25 z^-1), and nothing at z = 0.
  const auto found = zeros({1.0, -0.25, -0.125, 0.0});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(std::max(found[0].real(), found[1].real()), 0.5, 1e-12);
  EXPECT_NEAR(std::min(found[0].real(), found[1].real()), -0.25, 1e-12);
}

}  // namespace
}  // namespace loopscope::core::model
