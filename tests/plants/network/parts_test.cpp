#include "tests/plants/network/parts.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/generators/pi_controller.hpp"

namespace loopscope::tests::network {
namespace {

constexpr double kStep = 0.2;

TEST(PlantParts, APipeDelays) {
  Delay pipe = delay_of(1.0, kStep);
  for (int k = 0; k < 20; ++k) EXPECT_EQ(pipe.step(k), k < 5 ? 0.0 : k - 5);
  Delay none = delay_of(0.0, kStep);
  EXPECT_EQ(none.step(3.0), 3.0);
}

TEST(PlantParts, ALagReachesTwoThirdsInOneTimeConstant) {
  Lag lag = lag_of(10.0, kStep);
  for (int k = 0; k < 50; ++k) lag.step(1.0);
  EXPECT_NEAR(lag.value(), 1.0 - std::exp(-1.0), 1e-12);
}

TEST(PlantParts, AVesselFills) {
  ProcessState vessel({true, 0.01, 0.0, 0.0, 0.0}, kStep);
  for (int k = 0; k < 500; ++k) vessel.step(2.0, 1.0);
  EXPECT_NEAR(vessel.pv(), 0.01 * 3.0 * 100.0, 1e-9);
}

TEST(PlantParts, AControllerIntegratesAndStopsAtItsLimits) {
  generators::PiController controller(50.0);
  const auto step = [&](double error) { return controller.step(error, 2.0, 10.0); };
  EXPECT_NEAR(step(1.0), 50.0 + 2.0 * 1.1, 1e-12);
  EXPECT_NEAR(step(1.0), 50.0 + 2.0 * 1.2, 1e-12);
  for (int k = 0; k < 1000; ++k) step(10.0);
  EXPECT_EQ(controller.op(), 100.0);
  EXPECT_LT(step(9.0), 100.0);
}

}  // namespace
}  // namespace loopscope::tests::network
