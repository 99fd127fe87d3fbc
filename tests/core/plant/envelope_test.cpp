#include "core/plant/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <vector>

namespace loopscope::core::plant {
namespace {

constexpr double kStart_s = 1.7e9;

/// cos(2 pi f t + turn) in absolute time, with a mean and a third harmonic.
std::vector<double> wave(double interval_s, std::size_t samples, double frequency, double turn) {
  std::vector<double> values;
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) * interval_s + kStart_s;
    const double phase = 2.0 * std::numbers::pi * std::fmod(frequency * t, 1.0) + turn;
    values.push_back(7.0 + std::cos(phase) + 0.3 * std::cos(3.0 * phase));
  }
  return values;
}

MemberLoop loop_of(const std::vector<double>& error, double interval_s) {
  MemberLoop loop;
  loop.sample_interval_s = interval_s;
  loop.start_us = std::llround(kStart_s * 1e6);
  loop.error = error;
  return loop;
}

TEST(Envelope, IsHalfTheAmplitudeWithItsPhaseAndSeesNoMeanOrHarmonic) {
  const std::vector<double> error = wave(1.0, 1000, 0.02, 0.7);
  const Envelope envelope = make_envelope(loop_of(error, 1.0), 0.02);
  ASSERT_GE(envelope.points.size(), 16U);
  for (const std::complex<double> z : envelope.points) {
    EXPECT_NEAR(std::abs(z), 0.5, 1e-3);
    EXPECT_NEAR(std::arg(z), 0.7, 3e-3);
  }
}

TEST(Envelope, IsTheSameWhateverTheSampling) {
  const std::vector<double> fast = wave(1.0, 3000, 0.01, 0.3);
  const std::vector<double> slow = wave(7.0, 400, 0.01, 0.3);
  const Envelope one = make_envelope(loop_of(fast, 1.0), 0.01);
  const Envelope other = make_envelope(loop_of(slow, 7.0), 0.01);
  ASSERT_GE(one.points.size(), other.points.size() - 1);
  for (std::int64_t j = std::max(one.first, other.first); j < std::min(one.end(), other.end()); ++j)
    EXPECT_NEAR(std::abs(one.at(j) - other.at(j)), 0.0, 5e-3) << j;
}

TEST(Envelope, UnitsDoNotMatter) {
  const std::vector<double> error = wave(1.0, 1000, 0.02, 0.7);
  const Envelope envelope = make_envelope(loop_of(error, 1.0), 0.02);
  for (const double unit : {1e30, 1e-30}) {
    std::vector<double> scaled = error;
    for (double& value : scaled) value *= unit;
    const Envelope other = make_envelope(loop_of(scaled, 1.0), 0.02);
    ASSERT_EQ(other.points.size(), envelope.points.size());
    for (std::int64_t j = envelope.first; j < envelope.end(); ++j)
      EXPECT_NEAR(std::abs(other.at(j) / unit - envelope.at(j)), 0.0, 1e-6) << unit;
  }
}

TEST(Envelope, AnotherFrequencyTurns) {
  const std::vector<double> error = wave(1.0, 2000, 0.0202, 0.0);
  const Envelope envelope = make_envelope(loop_of(error, 1.0), 0.02);
  // One per cent of a turn a period.
  for (std::size_t k = 1; k < envelope.points.size(); ++k)
    EXPECT_NEAR(std::arg(envelope.points[k] * std::conj(envelope.points[k - 1])),
                2.0 * std::numbers::pi * 0.01, 5e-3);
}

TEST(Envelope, BridgesShortHolesAndLeavesLongOnesOut) {
  std::vector<double> error = wave(1.0, 2000, 0.02, 0.7);
  for (std::size_t k = 500; k < 510; ++k) error[k] = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 1000; k < 1300; ++k) error[k] = std::numeric_limits<double>::infinity();
  const Envelope envelope = make_envelope(loop_of(error, 1.0), 0.02);
  std::size_t missing = 0;
  for (const std::complex<double> z : envelope.points) {
    if (!std::isfinite(z.real()))
      ++missing;
    else
      EXPECT_NEAR(std::abs(z), 0.5, 0.1);
  }
  EXPECT_GE(missing, 5U);
  EXPECT_LE(missing, 9U);
}

TEST(Envelope, IsEmptyWhereThePeriodDoesNotFit) {
  const std::vector<double> error = wave(1.0, 1000, 0.02, 0.0);
  EXPECT_TRUE(make_envelope(loop_of(error, 1.0), 0.3).points.empty());
  EXPECT_TRUE(make_envelope(loop_of(error, 1.0), 0.005).points.empty());
  EXPECT_TRUE(make_envelope(loop_of({}, 1.0), 0.02).points.empty());
  EXPECT_FALSE(std::isfinite(Envelope{}.at(0).real()));
}

}  // namespace
}  // namespace loopscope::core::plant
