#include "core/model/display_window.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

using tests::Series;

constexpr std::size_t kStretchSamples = 4000;

Series cycling_op(double period) {
  Series op(kStretchSamples);
  for (std::size_t k = 0; k < kStretchSamples; ++k)
    op[k] = 50.0 + 5.0 * std::sin(2.0 * std::numbers::pi * static_cast<double>(k) / period);
  return op;
}

Series nothing() {
  return Series(kStretchSamples, 0.0);
}

TEST(TellingStretch, ShowsSixCyclesOfOp) {
  EXPECT_NEAR(static_cast<double>(telling_stretch(cycling_op(60.0), nothing(), 0).size()), 360.0,
              10.0);
  EXPECT_EQ(telling_stretch(cycling_op(10.0), nothing(), 0).size(), 200U);
  EXPECT_EQ(telling_stretch(cycling_op(1000.0), nothing(), 0).size(), 600U);
}

TEST(TellingStretch, HasTheFewestAskedForAndNoMoreThanThereAre) {
  EXPECT_EQ(telling_stretch(cycling_op(60.0), nothing(), 900).size(), 900U);
  const Range all = telling_stretch(cycling_op(60.0), nothing(), 9000);
  EXPECT_EQ(all.first, 0U);
  EXPECT_EQ(all.end, kStretchSamples);
}

TEST(TellingStretch, LiesAboutAGainAtOnePlace) {
  Series gain = nothing();
  gain[3000] = 1.0;
  const Range stretch = telling_stretch(cycling_op(60.0), gain, 0);
  EXPECT_NEAR(static_cast<double>(stretch.first + stretch.end) / 2.0, 3000.0, 5.0);
}

TEST(TellingStretch, StaysWithinTheRecord) {
  for (const std::size_t at : {std::size_t{0}, kStretchSamples - 1}) {
    Series gain = nothing();
    gain[at] = 1.0;
    const Range stretch = telling_stretch(cycling_op(60.0), gain, 0);
    EXPECT_LE(stretch.first, at);
    EXPECT_LT(at, stretch.end);
    EXPECT_LE(stretch.end, kStretchSamples);
  }
}

TEST(TellingStretch, GoesWhereTheEffectIsAtWorkForLongest) {
  Series gain = nothing();
  for (std::size_t k = 700; k < 1300; ++k) gain[k] = 0.1;
  gain[3000] = 5.0;
  gain[1000] = std::numeric_limits<double>::quiet_NaN();
  const Range stretch = telling_stretch(cycling_op(60.0), gain, 0);
  EXPECT_NEAR(static_cast<double>(stretch.first + stretch.end) / 2.0, 1000.0, 150.0);
}

TEST(TellingStretch, WithoutAGainIsTheMiddle) {
  const Range stretch = telling_stretch(cycling_op(60.0), nothing(), 0);
  EXPECT_NEAR(static_cast<double>(stretch.first + stretch.end) / 2.0, 2000.0, 1.0);
  EXPECT_EQ(telling_stretch(cycling_op(60.0), Series(kStretchSamples, -1.0), 0).first,
            stretch.first);
}

}  // namespace
}  // namespace loopscope::core::model
