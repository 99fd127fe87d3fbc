#include "core/model/limit_cycle/driven_cycle.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace loopscope::core::model {
namespace {

constexpr std::size_t kCycleSamples = 2000;

std::vector<double> wave(double amplitude, double cycles) {
  std::vector<double> result;
  for (std::size_t k = 0; k < kCycleSamples; ++k) {
    const double turn = 2.0 * std::numbers::pi * cycles * static_cast<double>(k) / kCycleSamples;
    result.push_back(50.0 + amplitude * std::sin(turn));
  }
  return result;
}

/// pv swings by 1, ten times; sp as said.
bool driven(const std::vector<double>& sp) {
  const std::vector<double> pv = wave(1.0, 10.0);
  ModelInput input;
  input.pv = pv;
  input.sp = sp;
  CycleEvidence cycle;
  cycle.cycles = 10.0;
  return driven_by_setpoint(input, cycle);
}

TEST(DrivenCycle, AsOftenAsTheSetpointTurns) {
  EXPECT_TRUE(driven(wave(1.0, 10.0)));
  EXPECT_TRUE(driven(wave(1.0, 8.0)));
}

TEST(DrivenCycle, TwiceAsOftenIsTheLoopsOwn) {
  EXPECT_FALSE(driven(wave(1.0, 5.0)));
  EXPECT_FALSE(driven(wave(1.0, 2.0)));
}

TEST(DrivenCycle, ASetpointThatHardlyMovesOrIsNotRecordedDrivesNothing) {
  EXPECT_FALSE(driven(wave(0.05, 10.0)));
  EXPECT_FALSE(driven(std::vector<double>(kCycleSamples, 50.0)));
  EXPECT_FALSE(driven({}));
}

}  // namespace
}  // namespace loopscope::core::model
