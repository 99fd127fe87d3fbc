#include "core/plant/event.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/core/plant/oscillators.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::plant {
namespace {

using tests::Course;
using tests::draw_course;
using tests::draw_error;
using tests::OscillatingPlant;
using tests::uniform;

using loopscope::tests::kWindow;

TEST(Event, IndependentLoopsOfNearEqualPeriodsAreNotJoined) {
  // Twelve loops within 2 % of one period, each with a wander of its own: 66 pairs that all have to
  // be told apart. The settings promise one plant in a hundred.
  constexpr int kPlants = 150;
  std::mt19937_64 random(21);
  int false_events = 0;
  for (int plant_number = 0; plant_number < kPlants; ++plant_number) {
    OscillatingPlant plant;
    const double period = std::exp(uniform(std::log(15.0), std::log(200.0), random));
    for (int k = 0; k < 12; ++k) {
      const double own = period * uniform(0.98, 1.02, random);
      const double increments = std::exp(uniform(std::log(0.02), std::log(0.8), random));
      plant.add(draw_course(kWindow + 600, own, increments, random), own, random);
    }
    plant.finish();
    false_events += find_events(plant.loops, {}).empty() ? 0 : 1;
  }
  // 1.5 expected at the stated rate; six or more come with a chance of 0.5 %.
  EXPECT_LE(false_events, 5);
}

TEST(Event, LoopsOfOneCourseAreOneEventAmongOthers) {
  constexpr int kPlants = 30;
  std::mt19937_64 random(22);
  std::size_t found = 0, strangers = 0, events = 0;
  for (int plant_number = 0; plant_number < kPlants; ++plant_number) {
    OscillatingPlant plant;
    const double period = std::exp(uniform(std::log(15.0), std::log(200.0), random));
    const Course course = draw_course(kWindow + 600, period, uniform(0.1, 0.6, random), random);
    for (int k = 0; k < 6; ++k) plant.add(course, period, random);
    for (int k = 0; k < 6; ++k) {
      const double own = period * uniform(0.9, 1.1, random);
      plant.add(draw_course(kWindow + 600, own, 0.3, random), own, random);
    }
    plant.finish();
    const std::vector<Event> all = find_events(plant.loops, {});
    events += all.size();
    for (const Event& event : all)
      for (const EventMember& one : event.members) ++(one.index < 6 ? found : strangers);
  }
  EXPECT_GE(found, 170U);     // of 180
  EXPECT_LE(strangers, 18U);  // a tenth of them: the rate of the settings is 5 %
  EXPECT_LE(events, 34U);
}

/// Every `step`-th sample of the newest `count`, with a fifth of them lost in ten gaps.
std::vector<double> worn(const std::vector<double>& error, std::size_t step, std::size_t count,
                         std::mt19937_64& random) {
  std::vector<double> kept;
  for (std::size_t k = error.size() - count; k < error.size(); k += step) kept.push_back(error[k]);
  const std::size_t gap = kept.size() / 50;
  for (int number = 0; number < 10; ++number) {
    const auto from =
        static_cast<std::size_t>(uniform(0.0, static_cast<double>(kept.size() - gap), random));
    std::fill_n(kept.begin() + static_cast<std::ptrdiff_t>(from), gap,
                std::numeric_limits<double>::quiet_NaN());
  }
  return kept;
}

TEST(Event, APeriodThatDriftsInWornRecordsOfSeveralSamplingsIsOneEvent) {
  constexpr int kPlants = 20;
  constexpr double kPeriod = 60.0;
  std::mt19937_64 random(24);
  std::size_t found = 0, strangers = 0, events = 0;
  for (int plant_number = 0; plant_number < kPlants; ++plant_number) {
    Course course = draw_course(kWindow + 600, kPeriod, 0.2, random);
    const double drift = uniform(-0.05, 0.05, random);  // of the frequency, from end to end
    for (std::size_t k = 0; k < course.phase.size(); ++k) {
      const double time = static_cast<double>(k) / static_cast<double>(kWindow) - 0.5;
      course.phase[k] += std::numbers::pi * drift * time * time * kWindow / kPeriod;
    }
    OscillatingPlant plant;
    for (int k = 0; k < 6; ++k) plant.add(course, kPeriod, random);
    for (int k = 0; k < 6; ++k)
      plant.add(draw_course(kWindow + 600, 31.0 + 7.0 * k, 0.4, random), 31.0 + 7.0 * k, random);
    const std::size_t steps[] = {1, 2, 5, 10}, counts[] = {kWindow, kWindow, 3000};
    for (std::size_t k = 0; k < plant.errors.size(); ++k)
      plant.errors[k] = worn(plant.errors[k], steps[k % 4], counts[k % 3], random);
    std::vector<MemberLoop> loops = plant.finish();
    for (std::size_t k = 0; k < loops.size(); ++k) {
      loops[k].sample_interval_s = static_cast<double>(steps[k % 4]);
      loops[k].start_us += 1'000'000LL * static_cast<std::int64_t>(kWindow - counts[k % 3]);
    }
    const std::vector<Event> all = find_events(loops, {});
    events += all.size();
    for (const Event& event : all)
      for (const EventMember& one : event.members) ++(one.index < 6 ? found : strangers);
  }
  EXPECT_GE(found, 108U);     // of 120
  EXPECT_LE(strangers, 12U);  // a tenth
  EXPECT_LE(events, 24U);
}

TEST(Event, ALineNeedsSeveralLoops) {
  std::mt19937_64 random(23);
  const Course line = draw_course(kWindow + 600, 60.0, 0.0, random);
  OscillatingPlant two, many;
  for (int k = 0; k < 2; ++k) two.add(line, 60.0, random);
  for (int k = 0; k < 10; ++k) many.add(line, 60.0, random);
  two.finish();
  many.finish();
  EXPECT_TRUE(find_events(two.loops, {}).empty());
  const std::vector<Event> events = find_events(many.loops, {});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_GE(events.front().members.size(), 9U);
}

TEST(Event, StrengthIsTheShareOfTheVariance) {
  std::mt19937_64 random(25);
  const Course course = draw_course(kWindow + 600, 60.0, 0.2, random);
  OscillatingPlant plant;
  for (const double noise : {0.1, 0.1, 1.0}) {
    plant.errors.push_back(draw_error(course, 60.0, 0, noise, kWindow, random));
  }
  plant.finish();
  const std::vector<Event> events = find_events(plant.loops, {});
  ASSERT_EQ(events.size(), 1U);
  // A cosine of amplitude 1 has variance 1/2.
  EXPECT_NEAR(events.front().members[0].strength, 0.5 / 0.51, 0.05);
  EXPECT_NEAR(events.front().members[2].strength, 0.5 / 1.5, 0.06);
}

TEST(Event, NothingComesOfNothing) {
  EXPECT_TRUE(find_events(std::span<const MemberLoop>(), {}).empty());
  const std::vector<double> still(kWindow, 0.0);
  const std::vector<MemberLoop> loops(5, tests::oscillating_loop(1, still));
  EXPECT_TRUE(find_events(loops, {}).empty());
}

}  // namespace
}  // namespace loopscope::core::plant
