#include "core/plant/following.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "tests/core/plant/oscillators.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::plant {
namespace {

using loopscope::tests::kWindow;
using tests::draw_course;
using tests::draw_error;
using tests::uniform;

Envelope envelope_of(const std::vector<double>& error, double period) {
  return make_envelope(tests::oscillating_loop(1, error), 1.0 / period);
}

double log_uniform(double low, double high, std::mt19937_64& random) {
  return std::exp(uniform(std::log(low), std::log(high), random));
}

TEST(Following, NoiseFollowsNothingMoreOftenThanItClaims) {
  std::mt19937_64 random(51);
  constexpr int kPairs = 800;
  int at_five = 0, at_one = 0;
  for (int k = 0; k < kPairs; ++k) {
    const double period = log_uniform(12.0, 150.0, random);
    const auto course = draw_course(kWindow, period, log_uniform(0.02, 0.8, random), random);
    const auto other = draw_course(kWindow, period, 3.0, random);  // no rhythm is left of it
    const double p =
        follow(envelope_of(draw_error(other, period, 0, 2.0, kWindow, random), period),
               envelope_of(draw_error(course, period, 0, 0.5, kWindow, random), period))
            .p;
    at_five += p <= 0.05 ? 1 : 0;
    at_one += p <= 0.01 ? 1 : 0;
  }
  EXPECT_LE(at_five, 0.08 * kPairs);
  EXPECT_LE(at_one, 0.02 * kPairs);
}

TEST(Following, AWeakVictimIsSeen) {
  // The wave makes up 4 % of the victim's variance.
  std::mt19937_64 random(52);
  constexpr int kPairs = 200;
  int seen = 0;
  for (int k = 0; k < kPairs; ++k) {
    const double period = log_uniform(12.0, 40.0, random);
    const auto course = draw_course(kWindow, period, uniform(0.1, 0.6, random), random);
    auto victim = draw_error(course, period, 0, 3.4, kWindow, random);
    const double p =
        follow(envelope_of(victim, period),
               envelope_of(draw_error(course, period, 0, 0.3, kWindow, random), period))
            .p;
    seen += p <= 0.01 ? 1 : 0;
  }
  EXPECT_GE(seen, 0.8 * kPairs);
}

TEST(Following, GainIsThatOfTheWave) {
  std::mt19937_64 random(53);
  const auto course = draw_course(kWindow, 30.0, 0.3, random);
  std::vector<double> one = draw_error(course, 30.0, 0, 0.1, kWindow, random);
  std::vector<double> twice = one;
  for (double& value : twice) value *= -2.0;
  const Following found = follow(envelope_of(twice, 30.0), envelope_of(one, 30.0));
  EXPECT_NEAR(std::abs(found.gain - std::complex<double>(-2.0)), 0.0, 1e-3);
  EXPECT_NEAR(found.rest / found.followed, 0.0, 1e-6);
  EXPECT_LE(found.p, 1e-12);
  const Following self = follow(envelope_of(one, 30.0), envelope_of(one, 30.0));
  EXPECT_EQ(self.p, 0.0);
}

TEST(Following, NeedsEnoughInCommon) {
  std::mt19937_64 random(54);
  const auto course = draw_course(kWindow, 400.0, 0.3, random);
  const auto error = draw_error(course, 400.0, 0, 0.1, kWindow, random);
  EXPECT_EQ(follow(envelope_of(error, 400.0), Envelope{}).p, 1.0);
  Envelope late = envelope_of(error, 400.0);
  late.first += 4;
  EXPECT_EQ(follow(envelope_of(error, 400.0), late).p, 1.0);
}

}  // namespace
}  // namespace loopscope::core::plant
