#include "core/simulate/band_pass.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <stdexcept>

namespace loopscope::core::simulate {
namespace {

TEST(BandPass, ButterworthHasHalfThePowerAtItsEdges) {
  const BandPass filter(0.095, 0.105);
  EXPECT_NEAR(filter.magnitude(0.095), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(filter.magnitude(0.105), std::sqrt(0.5), 1e-9);
}

TEST(BandPass, IsFlatAtTheCentreAndFallsOutside) {
  const BandPass filter(0.095, 0.105);
  EXPECT_NEAR(filter.magnitude(0.0999), 1.0, 1e-3);
  EXPECT_LT(filter.magnitude(0.05), 0.02);
  EXPECT_LT(filter.magnitude(0.2), 0.02);
  EXPECT_EQ(filter.magnitude(0.0), 0.0);
}

TEST(BandPass, AnswersASinusoidAsItsMagnitudeSays) {
  const BandPass filter(0.095, 0.105);
  std::vector<double> input(4000);
  for (std::size_t k = 0; k < input.size(); ++k) {
    input[k] = std::sin(2.0 * std::numbers::pi * 0.095 * static_cast<double>(k));
  }
  const std::vector<double> output = filter.filter(input);
  double power = 0.0;
  for (std::size_t k = 3000; k < 4000; ++k) {
    power += 2.0 * output[k] * output[k] / 1000.0;
  }
  // 1000 samples hold 95 whole cycles, so that only what is left of the start-up errs.
  EXPECT_NEAR(power, 0.5, 1e-6);
}

TEST(BandPass, RefusesEdgesOutOfOrder) {
  EXPECT_THROW(BandPass(0.2, 0.1), std::invalid_argument);
  EXPECT_THROW(BandPass(0.0, 0.1), std::invalid_argument);
  EXPECT_THROW(BandPass(0.1, 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::simulate
