#include "core/model/controller/simc.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

#include "core/model/controller/closed_loop.hpp"

namespace loopscope::core::model {
namespace {

TEST(Simc, RulesByHand) {
  // Kc = T / (k 2 theta), tau_i = min(T, 8 theta).
  const ControllerLaw fast = simc_law({false, 2.0, 10.0, 0.0, 5.0}, 1.0);
  EXPECT_DOUBLE_EQ(fast.gain, 0.5);
  EXPECT_DOUBLE_EQ(fast.integral, 0.05);
  const ControllerLaw slow = simc_law({false, 2.0, 100.0, 0.0, 5.0}, 1.0);
  EXPECT_DOUBLE_EQ(slow.gain, 5.0);
  EXPECT_DOUBLE_EQ(slow.integral, 5.0 / 40.0);
  const ControllerLaw level = simc_law({true, -0.02, 0.0, 0.0, 5.0}, 1.0);
  EXPECT_DOUBLE_EQ(level.gain, -5.0);
  EXPECT_DOUBLE_EQ(level.integral, -5.0 / 40.0);
}

TEST(Simc, ProcessWithoutLagGetsIntegralActionOnly) {
  const ControllerLaw law = simc_law({false, 2.0, 0.0, 0.0, 5.0}, 1.0);
  EXPECT_EQ(law.gain, 0.0);
  EXPECT_DOUBLE_EQ(law.integral, 1.0 / 20.0);
}

TEST(Simc, GivesTheRobustnessItPromises) {
  // Skogestad 2003, table 1: Ms 1.59 (first order) and 1.70 (integrating), in continuous time.
  const ProcessFit first{false, 1.0, 60.0, 0.0, 20.0};
  const ProcessFit level{true, 0.01, 0.0, 0.0, 20.0};
  EXPECT_NEAR(close_loop(first, simc_law(first, 1.0), 1.0).peak_sensitivity, 1.59, 0.05);
  EXPECT_NEAR(close_loop(level, simc_law(level, 1.0), 1.0).peak_sensitivity, 1.70, 0.05);
}

TEST(Simc, NoGainNoRules) {
  EXPECT_THROW((void)simc_law({}, 1.0), std::invalid_argument);
  EXPECT_THROW((void)simc_law({false, 1.0, 1.0, 0.0, 1.0}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::model
