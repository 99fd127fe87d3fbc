#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <gtest/gtest.h>
#include <vector>

#include "core/plant/event.hpp"
#include "tests/core/plant/oscillators.hpp"

/// Long runs whose figures stand in core/plant/README.md; by hand.
namespace loopscope::core::plant {
namespace {

using testing::draw_course;
using testing::draw_error;
using testing::uniform;

constexpr std::size_t kSamples = 4096;
constexpr std::size_t kRecord = kSamples + 600;  // room for lags

double log_uniform(double low, double high, std::mt19937_64& random) {
  return std::exp(uniform(std::log(low), std::log(high), random));
}

struct Plant {
  std::vector<std::vector<double>> errors;
  std::vector<double> periods;  ///< 0 = no oscillation of its own
  std::vector<int> groups;      ///< of the shared oscillation; -1 = none

  void add(const testing::Course& course, double period, int group, std::mt19937_64& random) {
    const auto lag = static_cast<std::size_t>(uniform(0.0, std::min(600.0, period), random));
    errors.push_back(draw_error(course, period, lag, uniform(0.2, 0.8, random), kSamples, random));
    periods.push_back(period);
    groups.push_back(group);
  }
  [[nodiscard]] std::vector<MemberLoop> loops() const {
    std::vector<MemberLoop> loops;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      loops.push_back(
          testing::oscillating_loop(static_cast<std::int64_t>(k), errors[k], periods[k]));
      if (periods[k] == 0.0) loops.back().oscillation = {};
    }
    return loops;
  }
};

TEST(PlantRates, DISABLED_FalseEventsAmongNearEqualPeriods) {
  constexpr int kPlants = 2000;
  for (const double spread : {0.003, 0.01, 0.02, 0.05}) {
    std::mt19937_64 random(101);
    int events = 0;
    for (int number = 0; number < kPlants; ++number) {
      Plant plant;
      const double period = log_uniform(15.0, 200.0, random);
      for (int k = 0; k < 12; ++k) {
        const double own = period * uniform(1.0 - spread, 1.0 + spread, random);
        plant.add(draw_course(kRecord, own, log_uniform(0.02, 0.8, random), random), own, -1,
                  random);
      }
      events += find_events(plant.loops(), {}).empty() ? 0 : 1;
    }
    std::printf("12 independent loops within %.1f %%: %.4f of %d plants show an event\n",
                100.0 * spread, events / static_cast<double>(kPlants), kPlants);
  }
}

TEST(PlantRates, DISABLED_Recall) {
  constexpr int kPlants = 200;
  for (const double wander : {0.0, 0.03, 0.1, 0.3, 0.6})
    for (const int members : {2, 3, 5, 10}) {
      std::mt19937_64 random(102);
      std::size_t found = 0, asked = 0;
      for (int number = 0; number < kPlants; ++number) {
        Plant plant;
        const double period = log_uniform(15.0, 200.0, random);
        const testing::Course course = draw_course(kRecord, period, wander, random);
        for (int k = 0; k < members; ++k) plant.add(course, period, 0, random);
        for (int k = 0; k < 6; ++k) {
          const double own = period * uniform(0.9, 1.1, random);
          plant.add(draw_course(kRecord, own, 0.3, random), own, -1, random);
        }
        asked += static_cast<std::size_t>(members);
        for (const Event& event : find_events(plant.loops(), {}))
          for (const Follower& one : event.followers)
            found += plant.groups[one.index] == 0 ? 1U : 0U;
      }
      std::printf("wander %.2f rad a period, %2d loops: %.3f of them joined\n", wander, members,
                  static_cast<double>(found) / static_cast<double>(asked));
    }
}

TEST(PlantRates, DISABLED_TenThousandLoops) {
  std::mt19937_64 random(103);
  Plant plant;
  constexpr int kGroups = 20, kMembers = 15, kOscillating = 2000, kLoops = 10000;
  for (int group = 0; group < kGroups; ++group) {
    const double period = log_uniform(12.0, 300.0, random);
    const testing::Course course = draw_course(kRecord, period, uniform(0.05, 0.6, random), random);
    for (int k = 0; k < kMembers; ++k) plant.add(course, period, group, random);
  }
  for (int k = kGroups * kMembers; k < kOscillating; ++k) {
    const double own = log_uniform(12.0, 300.0, random);
    plant.add(draw_course(kRecord, own, log_uniform(0.02, 0.8, random), random), own, -1, random);
  }
  for (int k = kOscillating; k < kLoops; ++k) {
    plant.add(draw_course(kRecord, 20.0, 1.5, random), 20.0, -1, random);
    plant.periods.back() = 0.0;
  }
  const std::vector<MemberLoop> loops = plant.loops();
  const std::clock_t start = std::clock();
  const std::vector<Event> events = find_events(loops, {});
  const double taken = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::size_t right = 0, members = 0;
  for (const Event& event : events) {
    std::array<std::size_t, kGroups> hits{};
    for (const Follower& one : event.followers)
      if (plant.groups[one.index] >= 0) ++hits[static_cast<std::size_t>(plant.groups[one.index])];
    right += *std::ranges::max_element(hits);
    members += event.followers.size();
  }
  std::printf(
      "%d loops, %d oscillating, %d shared by %d each: %zu events, %zu members, %zu of "
      "them right, %.1f s of processor\n",
      kLoops, kOscillating, kGroups, kMembers, events.size(), members, right, taken);
}

}  // namespace
}  // namespace loopscope::core::plant
