#include "core/plant/shared_oscillation.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <stdexcept>
#include <tuple>

#include "core/hos/numeric/normal_draw.hpp"
#include "tests/core/plant/oscillators.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::plant {
namespace {

using loopscope::tests::kWindow;

/// Six loops of one course. Loop 2 drives the others through lags, its output swings with it, and
/// its model has found a sticking valve; without `driven` all are copies of a wave from nowhere.
struct PlantOfSix {
  std::vector<std::vector<double>> errors;
  std::vector<double> output;
  std::vector<MemberLoop> loops;

  explicit PlantOfSix(bool driven = true) {
    std::mt19937_64 random(31);
    const tests::Course course = tests::draw_course(kWindow + 600, 60.0, 0.3, random);
    for (std::size_t k = 0; k < 6; ++k)
      errors.push_back(tests::draw_error(course, 60.0, driven ? 5 * k : 0, 0.3, kWindow, random));
    output = errors[2];
    for (double& value : output) value = 50.0 - 3.0 * value;
    for (std::size_t k = 0; driven && k < 6; ++k)
      if (k != 2) errors[k] = behind_a_lag(errors[2], 5.0 + static_cast<double>(k), random);
    for (std::size_t k = 0; k < 6; ++k)
      loops.push_back(tests::oscillating_loop(static_cast<std::int64_t>(100 + k), errors[k]));
    if (!driven) return;
    loops[2].op = output;
    loops[2].own = {Fault::friction, 0.9, 0.9, 0.0};
  }

  static std::vector<double> behind_a_lag(const std::vector<double>& from, double lag,
                                          std::mt19937_64& random) {
    std::vector<double> to(from.size(), 0.0);
    for (std::size_t k = 1; k < to.size(); ++k)
      to[k] = to[k - 1] + (from[k - 1] - to[k - 1]) / lag + 0.03 * hos::normal_draw(random);
    return to;
  }
};

const SharingLoop& member(const SharedOscillation& event, std::size_t index) {
  return *std::ranges::find(event.members, index, &SharingLoop::index);
}

TEST(SharedOscillation, IsOneEventWithOneSource) {
  const PlantOfSix plant;
  const std::vector<SharedOscillation> events = find_shared_oscillations(plant.loops);
  ASSERT_EQ(events.size(), 1U);
  const SharedOscillation& event = events.front();
  EXPECT_NEAR(event.period_s, 60.0, 0.5);
  EXPECT_LE(event.p, 1e-6);
  EXPECT_EQ(event.members.size(), 6U);
  ASSERT_EQ(event.source, 2U);
  EXPECT_EQ(event.members.front().index, 2U);
  EXPECT_EQ(event.members.front().role, Role::source);
  EXPECT_EQ(event.members.front().id, 102);
  EXPECT_EQ(event.ranking.front().index, 2U);
  EXPECT_EQ(event.ranking.size(), 6U);
  for (std::size_t k = 1; k < 6; ++k) EXPECT_EQ(event.members[k].role, Role::victim);
  EXPECT_NE(event.statement.find("It comes from L102"), std::string::npos) << event.statement;
  EXPECT_NE(event.statement.find("a period of 60"), std::string::npos) << event.statement;
}

TEST(SharedOscillation, WithoutOwnFindingsNoSourceIsNamed) {
  const PlantOfSix plant(false);
  const std::vector<SharedOscillation> events = find_shared_oscillations(plant.loops);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_FALSE(events.front().source.has_value());
  EXPECT_EQ(events.front().statement.find("It comes from"), std::string::npos);
}

TEST(SharedOscillation, AMemberWithAFaultOfItsOwnStaysOnTheList) {
  PlantOfSix plant;
  plant.loops[4].own.fault = Fault::sensor;
  plant.loops[4].own.confidence = 0.9;
  plant.loops[5].own.fault = Fault::tuning;
  plant.loops[5].own.confidence = 0.9;
  const SharedOscillation event = find_shared_oscillations(plant.loops).at(0);
  EXPECT_EQ(member(event, 4).role, Role::member);
  EXPECT_FALSE(leaves_work_list(member(event, 4).role));
  EXPECT_EQ(member(event, 5).role, Role::victim);
  EXPECT_NE(event.statement.find("kept on the list: L104"), std::string::npos) << event.statement;
}

TEST(SharedOscillation, FrictionThatTheSharedCycleShowsIsNoFaultOfItsOwn) {
  PlantOfSix plant;
  plant.loops[4].own.fault = Fault::friction;
  plant.loops[4].own.confidence = 0.9;
  const SharedOscillation event = find_shared_oscillations(plant.loops).at(0);
  EXPECT_EQ(member(event, 4).role, Role::victim);
  EXPECT_NE(event.statement.find("check these again: L104"), std::string::npos) << event.statement;
  PlantOfSix nobody(false);  // stands out
  nobody.loops[4].own.fault = Fault::friction;
  nobody.loops[4].own.confidence = 0.65;
  const SharedOscillation unclear = find_shared_oscillations(nobody.loops).at(0);
  ASSERT_FALSE(unclear.source.has_value());
  EXPECT_EQ(member(unclear, 4).role, Role::member);
  nobody.loops[4].own.confidence = 0.3;
  const SharedOscillation doubted = find_shared_oscillations(nobody.loops).at(0);
  EXPECT_EQ(member(doubted, 4).role, Role::victim);
  EXPECT_EQ(doubted.statement.find("check these again"), std::string::npos) << "there is no source";
}

TEST(SharedOscillation, WithoutASourceALoopThatIsTunedToSwingStaysOnTheList) {
  PlantOfSix plant(false);
  plant.loops[5].own.fault = Fault::tuning;
  plant.loops[5].own.confidence = 0.9;
  const SharedOscillation event = find_shared_oscillations(plant.loops).at(0);
  ASSERT_FALSE(event.source.has_value());
  EXPECT_EQ(member(event, 5).role, Role::member);
  EXPECT_NE(event.statement.find("kept on the list: L105."), std::string::npos) << event.statement;
}

TEST(SharedOscillation, ALoopThatItHardlyTouchesStaysOnTheList) {
  PlantOfSix plant;
  std::mt19937_64 random(32);
  std::vector<double> noisy = plant.errors[5];
  const tests::Course other = tests::draw_course(kWindow, 11.0, 1.0, random);
  const auto noise = tests::draw_error(other, 11.0, 0, 0.1, kWindow, random);
  for (std::size_t k = 0; k < kWindow; ++k) noisy[k] += 3.0 * noise[k];
  plant.loops[5].error = noisy;
  const SharedOscillation event = find_shared_oscillations(plant.loops).at(0);
  EXPECT_LT(member(event, 5).strength, 0.2);
  EXPECT_EQ(member(event, 5).role, Role::member);
  EXPECT_EQ(event.statement.find("finding of their own"), std::string::npos) << event.statement;
}

TEST(SharedOscillation, LagsAreTimesAfterTheSource) {
  // draw_error turns every loop by a phase of its own; without it the lags are the delays.
  PlantOfSix plant;
  std::mt19937_64 random(33);
  const tests::Course course = tests::draw_course(kWindow + 600, 60.0, 0.3, random);
  for (std::size_t k = 0; k < 6; ++k) {
    std::mt19937_64 same(34);
    plant.errors[k] = tests::draw_error(course, 60.0, 0, 0.1, kWindow, same);
    std::rotate(plant.errors[k].begin(), plant.errors[k].end() - static_cast<long>(4 * k),
                plant.errors[k].end());
    plant.loops[k].error = plant.errors[k];
  }
  const SharedOscillation event = find_shared_oscillations(plant.loops).at(0);
  const auto source = static_cast<double>(event.ranking.front().index);
  for (const SharingLoop& one : event.members)
    EXPECT_NEAR(one.lag_s, 4.0 * (static_cast<double>(one.index) - source), 0.5) << one.index;
}

TEST(SharedOscillation, TheOrderOfTheLoopsDoesNotMatter) {
  const PlantOfSix plant;
  std::vector<MemberLoop> turned(plant.loops.rbegin(), plant.loops.rend());
  const SharedOscillation one = find_shared_oscillations(plant.loops).at(0);
  const SharedOscillation other = find_shared_oscillations(turned).at(0);
  ASSERT_EQ(one.members.size(), other.members.size());
  EXPECT_EQ(other.source, 3U);
  for (const SharingLoop& a : one.members) {
    const SharingLoop& b = member(other, 5 - a.index);
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.role, b.role);
    EXPECT_NEAR(a.strength, b.strength, 0.01);
  }
}

TEST(SharedOscillation, CascadesHaveRolesOfTheirOwn) {
  PlantOfSix plant;
  std::vector<double> output(kWindow), setpoint(kWindow);
  for (std::size_t k = 0; k < kWindow; ++k) {
    output[k] = 50.0 + 5.0 * plant.errors[0][k];
    setpoint[k] = 20.0 + 0.5 * output[k];
  }
  plant.loops[0].op = output;
  plant.loops[1].sp = setpoint;
  const SharedOscillation event = find_shared_oscillations(plant.loops).at(0);
  EXPECT_EQ(member(event, 0).role, Role::cascade_master);
  EXPECT_EQ(member(event, 1).role, Role::cascade_slave);
  EXPECT_TRUE(leaves_work_list(Role::cascade_master));
  EXPECT_EQ(name(Role::cascade_slave), "cascade_slave");
}

TEST(SharedOscillation, RefusesWhatCannotBe) {
  PlantOfSix plant;
  PlantSettings settings;
  settings.event_p = 1.5;
  EXPECT_THROW(std::ignore = find_shared_oscillations(plant.loops, settings),
               std::invalid_argument);
  plant.loops[0].sample_interval_s = 0.0;
  EXPECT_THROW(std::ignore = find_shared_oscillations(plant.loops), std::invalid_argument);
  plant.loops[0].sample_interval_s = 1.0;
  const std::vector<double> shorter(10, 0.0);
  plant.loops[0].op = shorter;
  EXPECT_THROW(std::ignore = find_shared_oscillations(plant.loops), std::invalid_argument);
  EXPECT_TRUE(find_shared_oscillations({}).empty());
}

}  // namespace
}  // namespace loopscope::core::plant
