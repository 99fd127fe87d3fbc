#include "core/hos/numeric/magnitude.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::kInfinity;
using loopscope::tests::kNaN;

TEST(HosMagnitude, MissingSamplesHaveNone) {
  EXPECT_EQ(largest_magnitude(std::vector{kNaN, -3.0, kInfinity, 2.0}), 3.0);
  EXPECT_EQ(largest_magnitude(std::vector{kNaN, -kInfinity}), 0.0);
  EXPECT_EQ(first_finite(std::vector{kNaN, kInfinity, -3.0, 2.0}), -3.0);
  EXPECT_EQ(first_finite(std::vector{kNaN}), 0.0);
  EXPECT_EQ(first_finite({}), 0.0);
}

TEST(HosMagnitude, ScalingToUnitIsExactAndKeepsWhatIsMissing) {
  for (const double gain : {1.0, 0x1p900, 0x1p-900}) {
    const auto scaled = scaled_to_unit(std::vector{3.0 * gain, kNaN, -5.0 * gain, kInfinity});
    EXPECT_EQ(scaled[0], 0.75);
    EXPECT_TRUE(std::isnan(scaled[1]));
    EXPECT_EQ(scaled[2], -1.25);
    EXPECT_FALSE(std::isfinite(scaled[3]));
  }
  EXPECT_EQ(scaled_to_unit(std::vector{0.0, -0.0})[1], 0.0);
  EXPECT_TRUE(scaled_to_unit({}).empty());
}

TEST(HosMagnitude, MeanLeavesOutWhatIsMissing) {
  const FiniteMean found = finite_mean(std::vector<double>{1.0, kNaN, 5.0, kInfinity});
  EXPECT_EQ(found.mean, 3.0);
  EXPECT_EQ(found.count, 2.0);
  EXPECT_EQ(finite_mean({}).mean, 0.0);
  EXPECT_EQ(finite_mean(std::vector<double>(3, kNaN)).count, 0.0);
}

}  // namespace
}  // namespace loopscope::core::hos
