#include "core/loop/zero_crossings.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::core::loop {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(ZeroCrossings, LieOnTheLineBetweenTheNeighbours) {
  const std::vector<double> series{1.0, -3.0, -1.0, 1.0};
  EXPECT_THAT(find_zero_crossings(series), ElementsAre(DoubleEq(0.25), DoubleEq(2.5)));
}

TEST(ZeroCrossings, ZeroIsCrossedOnceAndTouchedNever) {
  const std::vector<double> crossed{1.0, 0.0, 0.0, -1.0}, touched{1.0, 0.0, 1.0};
  EXPECT_THAT(find_zero_crossings(crossed), ElementsAre(DoubleEq(1.5)));
  EXPECT_THAT(find_zero_crossings(touched), IsEmpty());
}

TEST(ZeroCrossings, AreNotReportedAcrossAGap) {
  const std::vector<double> series{1.0, std::nan(""), -1.0, 1.0};
  EXPECT_THAT(find_zero_crossings(series), ElementsAre(DoubleEq(2.5)));
}

}  // namespace
}  // namespace loopscope::core::loop
