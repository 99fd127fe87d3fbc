#include "daemon/calibrate/false_discovery.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace loopscope::daemon {
namespace {

TEST(CalibrateFalseDiscovery, StepsUpAsBenjaminiAndHochbergDo) {
  // Allowed at ranks 1 to 5: 0.01, 0.02, ..., 0.05. The third passes and takes the second along.
  const std::vector<double> p = {0.9, 0.005, 0.025, 0.029, 0.5};
  const FalseDiscovery result = control_false_discovery(p, 0.05);
  EXPECT_EQ(result.threshold, 0.029);
  EXPECT_EQ(result.flagged, (std::vector<bool>{false, true, true, true, false}));
}

TEST(CalibrateFalseDiscovery, WhatIsNotTestedCountsForNothing) {
  const double nan = std::nan("");
  const FalseDiscovery result = control_false_discovery(std::vector{nan, 0.04, nan, nan}, 0.05);
  EXPECT_EQ(result.flagged, (std::vector<bool>{false, true, false, false}));
  EXPECT_EQ(control_false_discovery(std::vector{nan, nan}, 0.05).flagged,
            (std::vector<bool>{false, false}));
}

TEST(CalibrateFalseDiscovery, NoneAndZero) {
  EXPECT_TRUE(control_false_discovery({}, 0.05).flagged.empty());
  EXPECT_EQ(control_false_discovery(std::vector{0.5, 0.9}, 0.05).threshold, 0.0);
  EXPECT_EQ(control_false_discovery(std::vector{0.0, 0.9}, 0.05).flagged,
            (std::vector<bool>{true, false}));
}

}  // namespace
}  // namespace loopscope::daemon
