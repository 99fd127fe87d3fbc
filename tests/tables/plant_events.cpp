#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

#include "core/plant/event.hpp"
#include "tests/core/plant/oscillators.hpp"
#include "tests/support/numbers.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::plant {
namespace {

using tests::draw_course;
using tests::OscillatingPlant;
using tests::uniform;

using loopscope::tests::kWindow;
constexpr std::size_t kRecord = kWindow + 600;  // room for lags

double log_uniform(double low, double high, std::mt19937_64& random) {
  return std::exp(uniform(std::log(low), std::log(high), random));
}

LOOPSCOPE_TABLE(plant_false_events, "events among independent loops of near equal periods") {
  constexpr int kPlants = 2000;
  for (const double spread : {0.003, 0.01, 0.02, 0.05}) {
    std::mt19937_64 random(101);
    int events = 0;
    for (int number = 0; number < kPlants; ++number) {
      OscillatingPlant plant;
      const double period = log_uniform(15.0, 200.0, random);
      for (int k = 0; k < 12; ++k) {
        const double own = period * uniform(1.0 - spread, 1.0 + spread, random);
        plant.add(draw_course(kRecord, own, log_uniform(0.02, 0.8, random), random), own, random);
      }
      events += find_events(plant.finish(), {}).empty() ? 0 : 1;
    }
    std::printf("12 independent loops within %.1f %%: %.4f of %d plants show an event\n",
                100.0 * spread, events / static_cast<double>(kPlants), kPlants);
  }
}

LOOPSCOPE_TABLE(plant_recall, "members of an event that are found") {
  constexpr int kPlants = 200;
  for (const double wander : {0.0, 0.03, 0.1, 0.3, 0.6})
    for (const int members : {2, 3, 5, 10}) {
      std::mt19937_64 random(102);
      std::size_t found = 0, asked = 0;
      for (int number = 0; number < kPlants; ++number) {
        OscillatingPlant plant;
        const double period = log_uniform(15.0, 200.0, random);
        const tests::Course course = draw_course(kRecord, period, wander, random);
        for (int k = 0; k < members; ++k) plant.add(course, period, random, 0);
        for (int k = 0; k < 6; ++k) {
          const double own = period * uniform(0.9, 1.1, random);
          plant.add(draw_course(kRecord, own, 0.3, random), own, random);
        }
        asked += static_cast<std::size_t>(members);
        for (const Event& event : find_events(plant.finish(), {}))
          for (const EventMember& one : event.members)
            found += plant.groups[one.index] == 0 ? 1U : 0U;
      }
      std::printf("wander %.2f rad a period, %2d loops: %.3f of them joined\n", wander, members,
                  static_cast<double>(found) / static_cast<double>(asked));
    }
}

LOOPSCOPE_TABLE(plant_ten_thousand_loops, "events and time of a plant of 10 000 loops") {
  std::mt19937_64 random(103);
  OscillatingPlant plant;
  constexpr int kGroups = 20, kMembers = 15, kOscillating = 2000, kLoops = 10000;
  for (int group = 0; group < kGroups; ++group) {
    const double period = log_uniform(12.0, 300.0, random);
    const tests::Course course = draw_course(kRecord, period, uniform(0.05, 0.6, random), random);
    for (int k = 0; k < kMembers; ++k) plant.add(course, period, random, group);
  }
  for (int k = kGroups * kMembers; k < kOscillating; ++k) {
    const double own = log_uniform(12.0, 300.0, random);
    plant.add(draw_course(kRecord, own, log_uniform(0.02, 0.8, random), random), own, random);
  }
  for (int k = kOscillating; k < kLoops; ++k) {
    plant.add(draw_course(kRecord, 20.0, 1.5, random), 20.0, random);
  }
  const std::vector<MemberLoop>& loops = plant.finish();
  const std::clock_t start = std::clock();
  const std::vector<Event> events = find_events(loops, {});
  const double taken = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::size_t right = 0, members = 0;
  for (const Event& event : events) {
    std::array<std::size_t, kGroups> hits{};
    for (const EventMember& one : event.members)
      if (plant.groups[one.index] >= 0) ++hits[static_cast<std::size_t>(plant.groups[one.index])];
    right += *std::ranges::max_element(hits);
    members += event.members.size();
  }
  std::printf(
      "%d loops, %d oscillating, %d shared by %d each: %zu events, %zu members, %zu of "
      "them right, %.1f s of processor\n",
      kLoops, kOscillating, kGroups, kMembers, events.size(), members, right, taken);
}

}  // namespace
}  // namespace loopscope::core::plant
