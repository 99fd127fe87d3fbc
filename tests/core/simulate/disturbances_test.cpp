#include "core/simulate/disturbances.hpp"

#include <gtest/gtest.h>

namespace loopscope::core::simulate {
namespace {

using Signal = std::vector<double>;

TEST(Disturbances, ALevelChangesBetweenItsPlaces) {
  EXPECT_EQ(with_level({1, 1, 1, 1}, 0.25, 0.75, 3.0), (Signal{1, 3, 3, 1}));
  EXPECT_EQ(with_level({1, 1, 1, 1}, 0.5, 1.0, 2.0), (Signal{1, 1, 2, 2}));
}

TEST(Disturbances, AStepStays) {
  EXPECT_EQ(with_step({0, 0, 0, 0}, 0.5, 5.0), (Signal{0, 0, 5, 5}));
}

TEST(Disturbances, ARunningSumIntegrates) {
  EXPECT_EQ(running_sum({1, 2, 3}), (Signal{1, 3, 6}));
}

}  // namespace
}  // namespace loopscope::core::simulate
