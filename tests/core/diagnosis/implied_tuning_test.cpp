#include "core/diagnosis/implied_tuning.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "core/model/closed_loop.hpp"
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
  const model::ProcessFit process{false, -2.0, 60.0, 30.0, 10.0};
  EXPECT_FALSE(slower_than_open_loop(loop, process)) << "no integral action";
  loop.integral_per_s = -0.005;
  EXPECT_FALSE(slower_than_open_loop(loop, process)) << "100 s, as the process itself";
  loop.integral_per_s = -0.0013;
  EXPECT_FALSE(slower_than_open_loop(loop, process));
  loop.integral_per_s = -0.0012;
  EXPECT_TRUE(slower_than_open_loop(loop, process));
}

/// Next to no gain, whose estimate may have either sign: the integral action alone counts.
TEST(ImpliedTuning, PureIntegralActionIsSlowByItself) {
  const model::ProcessFit process{false, 1.0, 3.0, 0.0, 2.0};
  for (const double gain : {0.001, 0.0, -0.005}) {
    model::ControllerLaw law;
    law.gain = gain;
    law.integral = 0.01;
    EXPECT_TRUE(slower_than_open_loop(model::close_loop(process, law, 1.0), process)) << gain;
    law.integral = 0.1;
    EXPECT_FALSE(slower_than_open_loop(model::close_loop(process, law, 1.0), process)) << gain;
  }
}

TEST(ImpliedTuning, NoDampingAtAllIsALineAndNoLoop) {
  model::ClosedLoop loop = ringing_loop();
  EXPECT_FALSE(undamped(loop));
  loop.damping = 0.01;
  EXPECT_TRUE(undamped(loop));
}

TEST(ImpliedTuning, TheErrorsMemoryIsMeasuredByIntegralTimeAndDelay) {
  model::ClosedLoop loop = slow_loop();
  loop::Performance performance;
  performance.longest_delay_s = 10.0;
  EXPECT_EQ(memory_ratio(loop, performance), 0.0) << "not measured";
  performance.error_memory_s = 120.0;
  EXPECT_DOUBLE_EQ(memory_ratio(loop, performance), 3.0);
  loop.integral_time_s = 2.0;
  EXPECT_DOUBLE_EQ(memory_ratio(loop, performance), 10.0) << "next to pure integral action";
  loop.integral_per_s = 0.0;
  EXPECT_EQ(memory_ratio(loop, performance), 0.0);
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
