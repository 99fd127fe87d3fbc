#include "core/plant/synchrony.hpp"

#include <array>
#include <gtest/gtest.h>

#include "tests/core/plant/oscillators.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::plant {
namespace {

using tests::Course;
using tests::draw_course;
using tests::draw_error;
using tests::uniform;

using loopscope::tests::kWindow;

struct Draw {
  double period = 0.0;
  double increments = 0.0;
};

Draw draw(std::mt19937_64& random) {
  return {std::exp(uniform(std::log(12.0), std::log(300.0), random)),
          std::exp(uniform(std::log(0.02), std::log(1.0), random))};
}

Increments wander_of(const std::vector<double>& error, double frequency) {
  return measure_increments(make_envelope(tests::oscillating_loop(1, error), frequency));
}

/// Two oscillators of one wander law: of one course, or each of its own with periods up to 2 %
/// apart.
Synchrony draw_pair(bool shared, std::mt19937_64& random) {
  const Draw one = draw(random);
  const Draw two = shared ? one : draw(random);
  const double other_period = shared ? one.period : one.period * uniform(0.98, 1.02, random);
  const Course first = draw_course(kWindow + 600, one.period, one.increments, random);
  const Course second =
      shared ? first : draw_course(kWindow + 600, other_period, two.increments, random);
  const auto lag = static_cast<std::size_t>(uniform(0.0, one.period, random));
  const double noise = uniform(0.1, 1.0, random);
  const auto a = draw_error(first, one.period, 0, noise, kWindow, random);
  const auto b = draw_error(second, other_period, lag, uniform(0.1, 1.0, random), kWindow, random);
  return compare(wander_of(a, 1.0 / one.period), wander_of(b, 1.0 / one.period));
}

TEST(Synchrony, IndependentOscillatorsOfNearEqualPeriodsPassAtTheStatedRate) {
  constexpr int kPairs = 1500;
  std::mt19937_64 random(11);
  std::array<int, 3> hits{};
  constexpr std::array<double, 3> kLevels = {0.1, 0.05, 0.01};
  for (int k = 0; k < kPairs; ++k) {
    const double p = draw_pair(false, random).p;
    for (std::size_t i = 0; i < kLevels.size(); ++i) hits[i] += p <= kLevels[i] ? 1 : 0;
  }
  // Three standard deviations above the level: 0.123, 0.067, 0.018.
  for (std::size_t i = 0; i < kLevels.size(); ++i)
    EXPECT_LE(hits[i], kPairs * kLevels[i] + 3.0 * std::sqrt(kPairs * kLevels[i])) << kLevels[i];
}

TEST(Synchrony, OneCourseIsRecognised) {
  constexpr int kPairs = 300;
  std::mt19937_64 random(12);
  int hits = 0;
  for (int k = 0; k < kPairs; ++k) hits += draw_pair(true, random).p <= 0.01 ? 1 : 0;
  // Measured 0.53: half of the draws wander by less than a fiftieth of a turn a period, or are seen
  // through as much noise, and one pair is asked; an event has many.
  EXPECT_GE(hits, 0.45 * kPairs);
}

TEST(Synchrony, TwoPerfectLinesHaveTheirFrequencyOnly) {
  std::mt19937_64 random(13);
  const Course line = draw_course(kWindow, 40.0, 0.0, random);
  const auto a = draw_error(line, 40.0, 0, 0.2, kWindow, random);
  const auto b = draw_error(line, 40.0, 0, 0.2, kWindow, random);
  const Synchrony found = compare(wander_of(a, 1.0 / 40.0), wander_of(b, 1.0 / 40.0));
  EXPECT_LE(found.frequency_p, 0.1);
  EXPECT_GE(found.p, 1e-4);
}

TEST(Synchrony, ATimeThatIsNotSharedSaysNothing) {
  std::mt19937_64 random(14);
  const Course course = draw_course(kWindow, 40.0, 0.3, random);
  const auto error = draw_error(course, 40.0, 0, 0.2, kWindow, random);
  Increments later = wander_of(error, 1.0 / 40.0);
  later.envelope.first += 10'000;
  const Synchrony found = compare(wander_of(error, 1.0 / 40.0), later);
  EXPECT_EQ(found.points, 0U);
  EXPECT_EQ(found.p, 1.0);
}

}  // namespace
}  // namespace loopscope::core::plant
