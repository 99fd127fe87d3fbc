#include "core/diagnosis/implied_tuning.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "tests/core/diagnosis/explanations.hpp"

namespace loopscope::core::diagnosis {
namespace {

TEST(ImpliedTuning, PoorDampingIsSensitivityOrDampingRatio) {
  model::ClosedLoop loop = calm_loop();
  EXPECT_FALSE(poorly_damped(loop));
  loop.peak_sensitivity = 2.6;
  EXPECT_TRUE(poorly_damped(loop));
  loop.peak_sensitivity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(poorly_damped(loop));
  loop = calm_loop();
  loop.damping = 0.19;
  EXPECT_TRUE(poorly_damped(loop));
}

TEST(ImpliedTuning, SlowIsMeasuredByTheProcess) {
  const model::ProcessFit process{false, 1.0, 20.0, 0.0, 5.0};
  model::ClosedLoop loop = slow_loop();
  EXPECT_TRUE(far_slower_than_possible(loop, process));
  loop.slowness = 3.5;
  EXPECT_FALSE(far_slower_than_possible(loop, process));
  model::ProcessFit vessel = process;
  vessel.integrating = true;
  EXPECT_FALSE(far_slower_than_possible(slow_loop(), vessel));
}

TEST(ImpliedTuning, AsSlowAsTheProcessItselfIsNotSlow) {
  model::ClosedLoop loop;
  loop.controller_gain = -0.5;
  loop.integral_time_s = 100.0;
  const model::ProcessFit process{false, -2.0, 60.0, 30.0, 10.0};
  EXPECT_FALSE(slower_than_open_loop(loop, process)) << "100 s, as the process itself";
  loop.controller_gain = -0.13;
  EXPECT_FALSE(slower_than_open_loop(loop, process));
  loop.controller_gain = -0.12;
  EXPECT_TRUE(slower_than_open_loop(loop, process));
}

TEST(ImpliedTuning, ResonanceIsAPeriodNotFarFromThePoles) {
  Evidence evidence;
  EXPECT_FALSE(at_resonance(evidence, ringing_loop()));
  oscillate(evidence, 66.0);
  EXPECT_TRUE(at_resonance(evidence, ringing_loop()));
  oscillate(evidence, 90.0);
  EXPECT_FALSE(at_resonance(evidence, ringing_loop()));
  EXPECT_FALSE(at_resonance(evidence, slow_loop())) << "these poles do not oscillate";
}

}  // namespace
}  // namespace loopscope::core::diagnosis
