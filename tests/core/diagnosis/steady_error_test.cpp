#include "core/diagnosis/steady_error.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string_view>

#include "core/signal/prepare.hpp"
#include "core/simulate/coloured_noise.hpp"
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
  EXPECT_EQ(steady.residual.size(), loop.error.size()) << "tests are made without the answer";
  EXPECT_EQ(&steady.tested(), &steady.residual);
}

TEST(SteadyError, MovesWithoutAnAnswerAreRefused) {
  signal::PreparedLoop loop = stepped_loop(60);
  // No stretch long enough to fit an answer to.
  for (std::size_t k = 0; k < loop.error.size(); k += 10) loop.error[k] = std::nan("");
  const SteadyError steady = steady_error(loop, {}, 1);
  ASSERT_NE(steady.flag, nullptr);
  EXPECT_EQ(std::string_view(steady.flag), "sp_moving");
  EXPECT_TRUE(steady.residual.empty());
  EXPECT_EQ(steady.refusal,
            "the setpoint moves too often to be left out, and no linear answer to it is found");
}

/// A loop under white noise whose noise is coloured in turns from sample `at` on, for `length`
/// samples each time.
signal::PreparedLoop changing_loop(std::size_t at, std::size_t length) {
  constexpr auto kGaussian = simulate::Innovation::gaussian;
  signal::LoopWindow window;
  window.pv = simulate::coloured_noise(simulate::resonance(20.0, 0.95), kGaussian, 4096, 1);
  const signal::Samples other =
      simulate::coloured_noise(simulate::real_pole(0.0), kGaussian, 4096, 2);
  for (std::size_t k = at; k < other.size(); ++k) {
    if ((k - at) / length % 2 == 0) window.pv[k] = other[k];
  }
  return signal::prepare(window, {});
}

TEST(SteadyError, OfALoopThatChangesTheLongestStretchIsKept) {
  const signal::PreparedLoop loop = changing_loop(1536, 4096);
  const SteadyError steady = steady_error(loop, {}, 1);
  EXPECT_FALSE(steady.stationary);
  EXPECT_EQ(steady.stretch, "samples 1665 to 4096 of 4096");
  EXPECT_TRUE(steady.refusal.empty());
  for (std::size_t k = 0; k < loop.error.size(); ++k) {
    if (k < 1664) {
      EXPECT_TRUE(std::isnan(steady.error[k])) << k;
    } else {
      EXPECT_EQ(steady.error[k], loop.error[k]) << k;
    }
  }
}

TEST(SteadyError, OfALoopThatAlwaysChangesNothingIsBelieved) {
  const signal::PreparedLoop loop = changing_loop(512, 512);
  const SteadyError steady = steady_error(loop, {}, 1);
  EXPECT_FALSE(steady.stationary);
  EXPECT_EQ(steady.refusal, "the loop changes too often: no stationary stretch is long enough");
  EXPECT_TRUE(steady.stretch.empty());
  EXPECT_EQ(steady.error, loop.error);
}

}  // namespace
}  // namespace loopscope::core
