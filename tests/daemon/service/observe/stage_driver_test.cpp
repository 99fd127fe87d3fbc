#include "daemon/service/observe/stage_driver.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <stdexcept>
#include <thread>

namespace loopscope::daemon {
namespace {

using storage::StageCost;

void work_for_ms(int ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

TEST(StageDriver, AUnitIsCountedWithoutThoseInsideIt) {
  StageDriver driver;
  driver.run(&StageCost::decide_s, [&] {
    work_for_ms(10);
    driver.run(&StageCost::wait_s, [] { work_for_ms(30); });
    work_for_ms(10);
  });
  EXPECT_GE(driver.last_ms(), 50.0);
  const StageCost cost = driver.take();
  EXPECT_GE(cost.decide_s, 0.020);
  EXPECT_GE(cost.wait_s, 0.030);
  EXPECT_NEAR(cost.decide_s + cost.wait_s, 1e-3 * driver.last_ms(), 1e-6);
  EXPECT_EQ(driver.cost().wait_s, 0.0) << "taken";
}

TEST(StageDriver, WhatIsSplitOffIsNotTheUnitsOwn) {
  StageDriver driver;
  double statistics_ms = 0.0;
  driver.run(&StageCost::decide_s, [&] {
    work_for_ms(20);
    statistics_ms = driver.split(&StageCost::statistics_s);
  });
  const StageCost cost = driver.take();
  EXPECT_GE(statistics_ms, 20.0);
  EXPECT_NEAR(cost.statistics_s, 1e-3 * statistics_ms, 1e-9);
  EXPECT_NEAR(cost.decide_s + cost.statistics_s, 1e-3 * driver.last_ms(), 1e-6);
}

TEST(StageDriver, WhatPassesBetweenUnitsBelongsToNone) {
  StageDriver driver;
  driver.run(&StageCost::fetch_s, [] {});
  work_for_ms(30);
  driver.run(&StageCost::fetch_s, [] {});
  EXPECT_LT(driver.take().fetch_s, 0.030);
}

TEST(StageDriver, GivesBackWhatTheWorkGaveAndShowsEachStep) {
  int steps = 0;
  StageDriver driver([&] { ++steps; });
  const auto made = driver.run(&StageCost::fetch_s, [] { return std::make_unique<int>(7); });
  EXPECT_EQ(*made, 7);
  EXPECT_THROW(driver.run(&StageCost::write_s, [] { throw std::runtime_error("away"); }),
               std::runtime_error);
  EXPECT_EQ(steps, 2);
}

TEST(StageDriver, AnExceptionEndsTheUnitsThatItPasses) {
  StageDriver driver;
  try {
    driver.run(&StageCost::decide_s,
               [&] { driver.run(&StageCost::write_s, [] { throw std::runtime_error("away"); }); });
  } catch (const std::runtime_error&) {
    work_for_ms(20);
  }
  driver.run(&StageCost::fetch_s, [] {});
  const StageCost cost = driver.take();
  EXPECT_LT(cost.decide_s + cost.write_s + cost.fetch_s, 0.020);
}

}  // namespace
}  // namespace loopscope::daemon
