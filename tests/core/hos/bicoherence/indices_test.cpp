#include "core/hos/bicoherence/indices.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace loopscope::core::hos {
namespace {

TEST(HosIndices, CriticalMeanByEquation11) {
  // (1.6448536 + sqrt(4095))^2 / (4 127 1024), and the figure of the reference implementation.
  EXPECT_NEAR(critical_mean_bic2(127, 1024, 0.05), 0.008281982624294715, 1e-17);
  // At alpha = 0.5 the quantile is zero: (4L - 1) / (4KL), just below the mean 1 / K.
  EXPECT_NEAR(critical_mean_bic2(127, 1024, 0.5), 4095.0 / (4.0 * 127.0 * 1024.0), 1e-17);
}

TEST(HosIndices, OfAFewValuesByHand) {
  const std::vector<double> bic2 = {0.1, 0.1, 0.1, 0.5};
  const Indices found = indices(bic2, 10, 0.05);
  EXPECT_NEAR(found.mean_bic2, 0.2, 1e-15);
  EXPECT_NEAR(found.std_bic2, std::sqrt((3 * 0.01 + 0.09) / 4.0), 1e-15);
  EXPECT_EQ(found.max_bic2, 0.5);
  EXPECT_NEAR(found.ngi, 0.2 - critical_mean_bic2(10, 4, 0.05), 1e-15);
  EXPECT_NEAR(found.nli, std::abs(0.5 - (0.2 + 2.0 * found.std_bic2)), 1e-15);
}

TEST(HosIndices, NliOfAFlatSurfaceIsZero) {
  EXPECT_NEAR(indices(std::vector<double>(1024, 0.3), 127, 0.05).nli, 0.0, 1e-12);
}

TEST(HosIndices, NliIsAMagnitude) {
  // Half zeros, half ones: max 1 lies below mean + 2 std = 1.5.
  EXPECT_NEAR(indices(std::vector<double>{0.0, 1.0}, 127, 0.05).nli, 0.5, 1e-15);
}

}  // namespace
}  // namespace loopscope::core::hos
