#include "core/signal/holes.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::core::signal {
namespace {

constexpr double kNot = kMissing;

TEST(Holes, OfADeadBandStayWithinTheBandOfTheValueStoredLast) {
  const Reconstruction whole = reconstruct({{1.0, kNot, kNot, 4.0, kNot}, Archive::dead_band, 1.0});
  EXPECT_EQ(whole.value, (Samples{1.0, 2.0, 2.0, 4.0, 4.0}));
  EXPECT_EQ(whole.low[1], 0.0);
  EXPECT_EQ(whole.high[2], 2.0);
  EXPECT_EQ(whole.low[4], 3.0);
  EXPECT_TRUE(std::isnan(whole.low[0]) && std::isnan(whole.high[3]));
}

TEST(Holes, OfASwingingDoorStayWithinTheBandOfTheLine) {
  const Reconstruction whole =
      reconstruct({{1.0, kNot, kNot, 4.0, kNot}, Archive::swinging_door, 0.5});
  EXPECT_EQ(whole.value[2], 3.0);
  EXPECT_EQ(whole.low[2], 2.5);
  EXPECT_EQ(whole.high[1], 2.5);
  EXPECT_TRUE(std::isnan(whole.value[4]));
}

TEST(Holes, OfWhichNothingIsKnownAreNotBounded) {
  const Reconstruction whole = reconstruct({{kNot, 1.0, kNot, 3.0}, Archive::scattered, 0.0});
  EXPECT_EQ(whole.value[2], 2.0);
  EXPECT_EQ(whole.low[2], -HUGE_VAL);
  EXPECT_EQ(whole.high[2], HUGE_VAL);
  EXPECT_TRUE(std::isnan(whole.value[0]));
}

TEST(Holes, LongerRunsAreGaps) {
  for (const auto& [archive, longest] : {std::pair{Archive::scattered, kLongestHole},
                                         std::pair{Archive::dead_band, kLongestBandedHole}}) {
    for (const std::size_t length : {longest, longest + 1}) {
      Samples stored(100, 1.0);
      for (std::size_t k = 10; k < 10 + length; ++k) stored[k] = kNot;
      const Reconstruction whole = reconstruct({stored, archive, 0.1});
      EXPECT_EQ(std::isfinite(whole.value[12]), length == longest);
    }
  }
}

TEST(Holes, AWholeRecordHasNone) {
  const Reconstruction whole = reconstruct({{1.0, 2.0}, Archive::complete, 0.0});
  EXPECT_EQ(whole.value, (Samples{1.0, 2.0}));
  EXPECT_TRUE(whole.low.empty() && whole.high.empty());
}

}  // namespace
}  // namespace loopscope::core::signal
