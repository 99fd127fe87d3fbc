#include "core/repair/standing_fault.hpp"

#include <gtest/gtest.h>

#include "tests/core/repair/repair_sample.hpp"

namespace loopscope::core::repair {
namespace {

std::vector<RepairWindow> together(std::vector<RepairWindow> some,
                                   const std::vector<RepairWindow>& others) {
  some.insert(some.end(), others.begin(), others.end());
  return some;
}

Side times(Side side, std::size_t windows, double confidence) {
  side.windows = windows;
  side.confidence = confidence;
  return side;
}

constexpr double kLeast = 0.3;

TEST(StandingFault, StandsWhereFaultsHaveHalfOfAllConfidence) {
  const auto stands = [](double healthy) {
    return side_verdict(
               together(windows_of(times(kSticks, 1, 0.8)), windows_of(times(kSound, 1, healthy))),
               kLeast)
        .stands.has_value();
  };
  EXPECT_TRUE(stands(0.8));
  EXPECT_FALSE(stands(0.81));
}

TEST(StandingFault, IsTheFamilyWithMostConfidenceAndItsMostFrequentVerdict) {
  auto windows = together(windows_of(times(kSticks, 2, 0.5)), windows_of(times(kTight, 1, 0.9)));
  windows[1].code = "valve_deadband";
  windows.push_back(windows[1]);
  const auto fault = side_verdict(windows, kLeast).stands;
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->family, "friction");
  EXPECT_EQ(fault->code, "valve_deadband");
  EXPECT_EQ(fault->windows, 3U);
  EXPECT_NEAR(fault->sure, 0.5, 1e-12);
  EXPECT_TRUE(fault->is_hardware);
}

TEST(StandingFault, DoubtfulVerdictsAreSuspicions) {
  const SideVerdict verdict = side_verdict(windows_of(times(kSticks, 3, 0.2)), kLeast);
  EXPECT_FALSE(verdict.stands);
  EXPECT_EQ(verdict.suspected, "valve_stiction");
  EXPECT_EQ(side_verdict(windows_of({"unexplained", "unknown", 1, 1, 0.2}), kLeast).suspected, "")
      << "what has no name suspects nothing in particular";
  EXPECT_EQ(side_verdict({}, kLeast).suspected, "");
}

TEST(StandingFault, HardwareIsWhatIsRepairedAndNotTuned) {
  for (const char* family : {"friction", "limit", "sensor", "curve"})
    EXPECT_TRUE(names_hardware(family)) << family;
  for (const char* family : {"oscillation", "slowness", "unknown", ""})
    EXPECT_FALSE(names_hardware(family)) << family;
}

}  // namespace
}  // namespace loopscope::core::repair
