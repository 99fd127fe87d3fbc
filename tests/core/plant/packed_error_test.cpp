#include "core/plant/packed_error.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

#include "tests/core/plant/oscillators.hpp"

namespace loopscope::core::plant {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr double kSteps = 65534.0;  // of the range

TEST(PackedError, IsWithinHalfAStepOfItsRangeAndMissesWhatWasMissing) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(40.0, 2.0);
  std::vector<double> error;
  for (int k = 0; k < 1000; ++k) error.push_back(normal(random));
  const auto [least, most] = std::ranges::minmax(error);
  error[7] = kMissing;
  error[9] = std::numeric_limits<double>::infinity();
  const PackedError packed(error, 2.0, 17);
  EXPECT_EQ(packed.sample_interval_s(), 2.0);
  EXPECT_EQ(packed.start_us(), 17);
  const signal::Samples again = packed.unpacked();
  ASSERT_EQ(again.size(), error.size());
  for (std::size_t k = 0; k < error.size(); ++k)
    if (k == 7 || k == 9) {
      EXPECT_TRUE(std::isnan(again[k])) << k;
    } else {
      EXPECT_NEAR(again[k], error[k], 0.501 * (most - least) / kSteps) << k;
    }
}

TEST(PackedError, AMeanIsTheLoopsOwnWhereNoSetpointIsKnown) {
  signal::PreparedLoop loop;
  loop.sp.assign(4, kMissing);
  EXPECT_EQ(error_about(loop), ErrorAbout::own_mean);
  EXPECT_EQ(PackedError(loop.sp, 1.0, 0, error_about(loop)).about(), ErrorAbout::own_mean);
  loop.sp[2] = 1.0;
  EXPECT_EQ(error_about(loop), ErrorAbout::setpoint);
}

TEST(PackedError, ConstantsEmptyOnesAndLargeNumbersStayWhatTheyAre) {
  EXPECT_TRUE(PackedError({}, 1.0, 0).empty());
  EXPECT_EQ(PackedError(std::vector(3, 4.5), 1.0, 0).unpacked(), signal::Samples(3, 4.5));
  for (const double value : PackedError(std::vector(3, kMissing), 1.0, 0).unpacked())
    EXPECT_TRUE(std::isnan(value));
  constexpr double kLargest = 1e307;
  const signal::Samples far = PackedError(std::vector{-kLargest, 0.0, kLargest}, 1.0, 0).unpacked();
  EXPECT_NEAR(far[0] / kLargest, -1.0, 1e-4);
  EXPECT_NEAR(far[2] / kLargest, 1.0, 1e-4);
}

TEST(PackedError, ARangeOfTheSmallestDifferencesKeepsItsOrder) {
  const std::vector<std::vector<double>> narrow = {{1e16, 1e16 + 2.0, 1e16 + 6.0},
                                                   {0.0, 5e-324, 1e-322}};
  for (const std::vector<double>& error : narrow) {
    const signal::Samples again = PackedError(error, 1.0, 0).unpacked();
    const double range = error.back() - error.front();
    for (std::size_t k = 0; k < error.size(); ++k)
      EXPECT_LE(std::abs(again[k] - error[k]), range) << k;
    EXPECT_LE(again[0], again[1]);
    EXPECT_LE(again[1], again[2]);
  }
}

TEST(PackedError, ItsEnvelopeIsThatOfTheError) {
  std::mt19937_64 random(4);
  for (const double period : {5.0, 40.0, 300.0}) {
    const tests::Course course = tests::draw_course(4096, period, 0.2, random);
    std::vector<double> error = tests::draw_error(course, period, 0, 0.5, 4096, random);
    for (std::size_t k = 1000; k < 1200; k += 3) error[k] = kMissing;
    const MemberLoop loop = tests::oscillating_loop(1, error);
    const Envelope exact = make_envelope(loop, 1.0 / period);
    const Envelope packed =
        PackedError(error, loop.sample_interval_s, loop.start_us).envelope(1.0 / period);
    ASSERT_EQ(packed.first, exact.first);
    ASSERT_EQ(packed.points.size(), exact.points.size());
    ASSERT_GE(packed.points.size(), 10U);
    for (std::size_t k = 0; k < exact.points.size(); ++k) {
      const bool known = !std::isnan(exact.points[k].real());
      ASSERT_EQ(!std::isnan(packed.points[k].real()), known) << k;
      EXPECT_NEAR(known ? std::abs(packed.points[k] - exact.points[k]) : 0.0, 0.0, 2e-4)
          << period << ' ' << k;
    }
  }
}

}  // namespace
}  // namespace loopscope::core::plant
