#include "core/diagnosis/steady_error.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string_view>

#include "core/signal/prepare.hpp"
#include "core/simulate/paper_loops.hpp"

namespace loopscope::core {
namespace {

/// The paper's loop with a setpoint step of ten error standard deviations every so many samples.
signal::PreparedLoop stepped_loop(std::size_t every) {
  simulate::LoopSettings settings = simulate::well_tuned_loop();
  for (std::size_t at = settings.discarded_samples + every / 2;
       every > 0 && at < settings.discarded_samples + settings.recorded_samples; at += every) {
    settings.setpoint_moves.push_back({at, at / every % 2 == 0 ? 8.0 : -8.0});
  }
  const simulate::LoopRecord record = simulate::simulate_loop(settings, 3);
  signal::LoopWindow window;
  window.sample_interval_s = record.sample_interval_s;
  window.sp = record.sp;
  window.pv = record.pv;
  window.op = record.op;
  return signal::prepare(window, {});
}

TEST(SteadyError, WithoutStepsItIsTheError) {
  const signal::PreparedLoop loop = stepped_loop(0);
  const SteadyError steady = steady_error(loop, {}, 1);
  EXPECT_EQ(steady.flag, nullptr);
  EXPECT_EQ(steady.error, loop.error);
}

TEST(SteadyError, StepsAreLeftOutAndFlagged) {
  const signal::PreparedLoop loop = stepped_loop(500);
  const SteadyError steady = steady_error(loop, {}, 1);
  ASSERT_NE(steady.flag, nullptr);
  EXPECT_EQ(std::string_view(steady.flag), "sp_steps_masked");
  EXPECT_GT(std::ranges::count_if(steady.error, [](double e) { return std::isnan(e); }), 100);
}

TEST(SteadyError, StepsThatLeaveTooLittleAreKept) {
  const signal::PreparedLoop loop = stepped_loop(60);
  const SteadyError steady = steady_error(loop, {}, 1);
  ASSERT_NE(steady.flag, nullptr);
  EXPECT_EQ(std::string_view(steady.flag), "sp_moving");
  EXPECT_EQ(steady.error, loop.error);
}

}  // namespace
}  // namespace loopscope::core
