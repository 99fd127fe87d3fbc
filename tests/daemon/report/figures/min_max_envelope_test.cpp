#include "daemon/report/figures/min_max_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace loopscope::daemon {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

TEST(Envelope, KeepsAShortSeriesWhole) {
  const auto points = envelope(std::vector{1.0, 3.0, 2.0}, 10.0, 2.0, 5);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[2].x, 14.0);
  EXPECT_EQ(points[1].y, 3.0);
}

TEST(Envelope, LosesNoExtremeAndKeepsTheOrderOfTime) {
  std::vector<double> samples;
  for (int k = 0; k < 4096; ++k) samples.push_back(std::sin(2.0 * std::numbers::pi * k / 37.0));
  samples[1234] = 9.0;  // a spike of one sample
  samples[3000] = -7.0;
  const auto points = envelope(samples, 0.0, 1.0, 440);
  EXPECT_LE(points.size(), 880U);
  const auto [low, high] = std::ranges::minmax(points, {}, &Point::y);
  EXPECT_EQ(high.y, 9.0);
  EXPECT_EQ(high.x, 1234.0);
  EXPECT_EQ(low.y, -7.0);
  EXPECT_TRUE(std::ranges::is_sorted(points, {}, &Point::x));
  for (const Point& point : points) EXPECT_EQ(point.y, samples[static_cast<std::size_t>(point.x)]);
}

TEST(Envelope, BreaksTheCurveWhereAColumnIsMissing) {
  std::vector<double> samples(1000, 1.0);
  std::fill(samples.begin() + 300, samples.begin() + 500, kMissing);
  const auto points = envelope(samples, 0.0, 1.0, 100);
  EXPECT_GE(std::ranges::count_if(points, [](const Point& p) { return std::isnan(p.y); }), 19);
  EXPECT_LE(points.size(), 200U);
}

TEST(Envelope, HoldsWhatIsNoNumber) {
  EXPECT_TRUE(envelope({}, 0.0, 1.0, 10).empty());
  const std::vector<double> nothing(50, kMissing);
  for (const Point& point : envelope(nothing, 0.0, 1.0, 10)) EXPECT_TRUE(std::isnan(point.y));
  const auto infinite = envelope(std::vector<double>{1.0, INFINITY}, 0.0, 1.0, 10);
  EXPECT_TRUE(std::isnan(infinite[1].y));
}

}  // namespace
}  // namespace loopscope::daemon
