#include "core/signal/setpoint_steps.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

#include "core/signal/prepare.hpp"

namespace loopscope::core::signal {
namespace {

/// A loop whose error is white noise of 1 plus what `follow` says of a setpoint that starts at 50.
LoopWindow noisy_window(const std::function<double(std::size_t k)>& sp,
                        const std::function<double(std::size_t k)>& follow) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  LoopWindow window;
  for (std::size_t k = 0; k < 4096; ++k) {
    window.sp.push_back(sp(k));
    window.pv.push_back(sp(k) - follow(k) - normal(random));
  }
  return window;
}

/// One step at sample 2000; the error decays with a time constant of 20 samples.
LoopWindow stepped_window(double size) {
  return noisy_window([size](std::size_t k) { return k < 2000 ? 50.0 : 50.0 + size; },
                      [size](std::size_t k) {
                        return k < 2000 ? 0.0 : size * std::exp((2000.0 - double(k)) / 20.0);
                      });
}

double no_error(std::size_t) {
  return 0.0;
}

ErrorBetweenSteps between(const LoopWindow& window) {
  return error_between_steps(prepare(window, {}));
}

/// One past the last masked sample from `first` on.
std::size_t masked_until(const Samples& error, std::size_t first) {
  while (first < error.size() && std::isnan(error[first])) ++first;
  return first;
}

TEST(SetpointSteps, AConstantSetpointLeavesTheErrorAsItIs) {
  const PreparedLoop loop = prepare(stepped_window(0.0), {});
  const ErrorBetweenSteps result = error_between_steps(loop);
  EXPECT_EQ(result.error, loop.error);
  EXPECT_EQ(result.steps, 0U);
  EXPECT_EQ(result.masked_fraction, 0.0);
}

TEST(SetpointSteps, TheTransientIsTakenOutAndTheRestStays) {
  const LoopWindow window = stepped_window(20.0);
  const ErrorBetweenSteps result = between(window);
  const std::size_t end = masked_until(result.error, 2000);
  EXPECT_EQ(result.steps, 1U);
  EXPECT_FALSE(std::isnan(result.error[1999]));
  // Below a third of the noise after 82 samples; twice as long would waste data.
  EXPECT_GE(end, 2082U);
  EXPECT_LE(end, 2164U);
  EXPECT_EQ(result.error[end], window.sp[end] - window.pv[end]);
}

TEST(SetpointSteps, AStepThatTheNoiseHidesIsLeftAlone) {
  EXPECT_EQ(between(stepped_window(0.4)).steps, 0U);
  EXPECT_EQ(between(stepped_window(0.7)).steps, 1U);
}

TEST(SetpointSteps, TheMaskKnowsNoUnits) {
  LoopWindow scaled = stepped_window(20.0);
  for (Samples* series : {&scaled.sp, &scaled.pv}) {
    for (double& v : *series) v *= 1024.0;
  }
  const ErrorBetweenSteps small = between(stepped_window(20.0));
  const ErrorBetweenSteps large = between(scaled);
  EXPECT_EQ(large.masked_fraction, small.masked_fraction);
  EXPECT_EQ(masked_until(large.error, 2000), masked_until(small.error, 2000));
}

TEST(SetpointSteps, AMoveOverSeveralSamplesIsOneStep) {
  const auto slewed = [](std::size_t k) {
    return 50.0 + 0.3 * std::min(std::max(double(k) - 1999.0, 0.0), 10.0);
  };
  const ErrorBetweenSteps result = between(noisy_window(slewed, no_error));
  EXPECT_EQ(result.steps, 1U);
  EXPECT_TRUE(std::isnan(result.error[2000]));
  EXPECT_EQ(masked_until(result.error, 2000), 2009U + 32U);
}

TEST(SetpointSteps, AStepDuringAGapIsSeenAfterIt) {
  LoopWindow window = stepped_window(20.0);
  for (std::size_t k = 1990; k < 2010; ++k) window.sp[k] = kMissing;
  const ErrorBetweenSteps result = between(window);
  EXPECT_EQ(result.steps, 1U);
  EXPECT_GE(masked_until(result.error, 2010), 2060U);
}

TEST(SetpointSteps, AStepJustBeforeTheWindowIsRememberedWhereSpIsStepped) {
  LoopWindow window = stepped_window(20.0);
  for (std::size_t k = 0; k < 100; ++k) window.pv[k] -= 20.0 * std::exp(-double(k) / 20.0);
  EXPECT_GE(masked_until(between(window).error, 0), 82U);
}

TEST(SetpointSteps, ALevelThatStaysEndsTheMaskAtItsLongest) {
  const auto offset = [](std::size_t k) { return k < 2000 ? 0.0 : 9.0; };
  const auto sp = [](std::size_t k) { return k < 2000 ? 50.0 : 70.0; };
  LoopWindow window = noisy_window(sp, offset);
  window.pv.resize(3000);
  window.sp.resize(3000);
  EXPECT_EQ(masked_until(between(window).error, 2000), 2512U);
}

TEST(SetpointSteps, AWanderingSetpointIsNotMasked) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  double state = 50.0;
  const auto cascade = [&](std::size_t) { return state += normal(random); };
  LoopWindow window = noisy_window([](std::size_t) { return 50.0; }, no_error);
  for (std::size_t k = 0; k < window.size(); ++k) {
    const double moved = cascade(k) - 50.0;
    window.sp[k] += moved;
    window.pv[k] += moved;
  }
  const PreparedLoop loop = prepare(window, {});
  const ErrorBetweenSteps result = error_between_steps(loop);
  EXPECT_GT(result.steps, 0U);
  EXPECT_EQ(result.masked_fraction, 0.0);
  for (const double e : result.error) EXPECT_FALSE(std::isnan(e));
}

TEST(SetpointSteps, AReturnFromManualIsMaskedUntilTheErrorHasSettled) {
  LoopWindow window = stepped_window(20.0);
  window.sp.assign(window.size(), 50.0);
  window.mode.assign(window.size(), ControlMode::automatic);
  for (std::size_t k = 1500; k < 2000; ++k) window.mode[k] = ControlMode::manual;
  for (std::size_t k = 2000; k < 2100; ++k) {
    window.pv[k] = 50.0 - 20.0 * std::exp((2000.0 - double(k)) / 20.0);
  }
  for (std::size_t k = 2100; k < window.size(); ++k) window.pv[k] -= 20.0;
  const ErrorBetweenSteps result = between(window);
  EXPECT_EQ(result.steps, 1U);
  EXPECT_GE(masked_until(result.error, 2000), 2050U);
}

TEST(SetpointSteps, ACoarseSensorHasAUsualErrorToo) {
  const auto rounded = [](std::size_t k) { return k % 10 == 0 ? 1.0 : 0.0; };
  LoopWindow window;
  for (std::size_t k = 0; k < 4096; ++k) {
    window.sp.push_back(k < 2000 ? 50.0 : 55.0);
    window.pv.push_back((k < 2010 ? 50.0 : 55.0) + rounded(k));
  }
  const ErrorBetweenSteps result = between(window);
  EXPECT_EQ(result.steps, 1U);
  EXPECT_EQ(masked_until(result.error, 2000), 2032U);
}

TEST(SetpointSteps, WithoutSetpointOrErrorThereIsNothingToMask) {
  LoopWindow no_setpoint = stepped_window(20.0);
  no_setpoint.sp.clear();
  EXPECT_EQ(between(no_setpoint).steps, 0U);
  PreparedLoop followed = prepare(stepped_window(20.0), {});
  followed.error.assign(followed.error.size(), 0.0);
  EXPECT_EQ(error_between_steps(followed).steps, 0U);
  EXPECT_TRUE(error_between_steps(PreparedLoop{}).error.empty());
}

}  // namespace
}  // namespace loopscope::core::signal
