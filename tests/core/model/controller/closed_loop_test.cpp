#include "core/model/controller/closed_loop.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <stdexcept>

#include "core/model/controller/polynomial_zeros.hpp"
#include "tests/core/model/known_loops.hpp"

namespace loopscope::core::model {
namespace {

const SampledProcess kIntegrator{{1.0}, {1.0, -1.0}, 1};

double slowest(const SampledProcess& process, const ControllerLaw& law) {
  double largest = 0.0;
  for (const auto& pole : zeros(characteristic(process, law))) {
    largest = std::max(largest, std::abs(pole));
  }
  return largest;
}

TEST(ClosedLoop, IntegratorWithGainOnlyHasItsClosedForm) {
  // 1 / (1 + G C) = (1 - z^-1) / (1 - (1 - k) z^-1): greatest at z = -1.
  for (const double k : {0.2, 0.5, 0.9}) {
    const ClosedLoop loop = close_loop(kIntegrator, known::law(k, 0.0), 2.0);
    EXPECT_NEAR(loop.peak_sensitivity, 2.0 / (2.0 - k), 1e-9);
    EXPECT_NEAR(loop.settling_s, 2.0 * std::log(0.02) / std::log(1.0 - k), 1e-9);
    EXPECT_EQ(loop.period_s, 0.0);
    EXPECT_EQ(loop.integral_time_s, 0.0);
  }
}

TEST(ClosedLoop, PairOfPolesHasItsPeriodAndDamping) {
  // z^2 - (2 - K - I) z + 1 - K: radius sqrt(1 - K).
  const double gain = 0.1, integral = 0.2;
  const ClosedLoop loop = close_loop(kIntegrator, known::law(gain, integral), 1.0);
  const double radius = std::sqrt(1.0 - gain);
  const double angle = std::acos((2.0 - gain - integral) / (2.0 * radius));
  EXPECT_NEAR(loop.period_s, 2.0 * std::numbers::pi / angle, 1e-9);
  EXPECT_NEAR(loop.damping, -std::log(radius) / std::hypot(std::log(radius), angle), 1e-9);
  EXPECT_NEAR(loop.settling_s, std::log(0.02) / std::log(radius), 1e-9);
}

TEST(ClosedLoop, ARingingLoopIsDescribedByWhatRingsNotByItsSlowEnd) {
  // A vessel behind dead time with a gain near the edge and slow integral action: most energy of
  // the answer to a load is in the slow real pole, and the error rings six to seven dead times.
  const SampledProcess vessel{{0.02}, {1.0, -1.0}, 8};
  const ClosedLoop loop = close_loop(vessel, known::law(7.5, 0.02), 1.0);
  EXPECT_GT(loop.peak_sensitivity, 3.0);
  EXPECT_NEAR(loop.period_s, 35.0, 5.0);
  EXPECT_LT(loop.damping, 0.2);
}

TEST(ClosedLoop, PaperLoopsHaveThePolesOfTheNotes) {
  // 0.784 and 0.847 are the radii of the slowest pairs of 5.1 and of 5.2 as printed.
  EXPECT_NEAR(slowest(known::paper_process(), known::law(0.15, 0.15)), 0.784, 5e-4);
  EXPECT_NEAR(slowest(known::paper_process(), known::law(0.15, 0.06)), 0.847, 5e-4);
}

TEST(ClosedLoop, PaperLoopsAreToldApart) {
  const ClosedLoop well = close_loop(known::paper_process(), known::law(0.15, 0.15), 1.0);
  const ClosedLoop printed = close_loop(known::paper_process(), known::law(0.15, 0.06), 1.0);
  const ClosedLoop excessive = close_loop(known::paper_process(), known::law(0.15, 0.375), 1.0);
  EXPECT_NEAR(well.peak_sensitivity, 1.80, 0.01);
  EXPECT_NEAR(printed.peak_sensitivity, 1.37, 0.01);
  EXPECT_GT(printed.settling_s, well.settling_s);
  // "Oscillates with a period of about 10 samples" (core/simulate/MEASURED.md).
  EXPECT_NEAR(excessive.period_s, 9.9, 0.1);
  EXPECT_LT(excessive.damping, 0.02);
  EXPECT_GT(excessive.peak_sensitivity, 30.0);
}

TEST(ClosedLoop, ZeroLeftOutLooksTighter) {
  // A ProcessFit has no zero: the same gain, lag and delay as equation 20.
  const known::KnownLoop loop = known::scenario("paper_5_1");
  EXPECT_NEAR(close_loop(loop.process, loop.law, 1.0).peak_sensitivity, 2.68, 0.01);
}

TEST(ClosedLoop, PlantLoopsAreToldApart) {
  const auto implied = [](const char* name) {
    const known::KnownLoop loop = known::scenario(name);
    return close_loop(loop.process, loop.law, 1.0);
  };
  EXPECT_LT(implied("healthy_flow").peak_sensitivity, 1.3);
  EXPECT_GT(implied("tight_tuning").peak_sensitivity, 15.0);
  EXPECT_GT(implied("sluggish_tuning").settling_s, 20.0 * implied("healthy_flow").settling_s);
  // Poles 0.9689 and 0.9436 by the cubic z^2 (z - 1) - ... of the level loop.
  EXPECT_NEAR(implied("level_loop").settling_s, 123.9, 0.1);
}

TEST(ClosedLoop, UnstableIsInfinite) {
  const ClosedLoop loop = close_loop(known::paper_process(), known::law(0.15, 0.5), 1.0);
  EXPECT_TRUE(std::isinf(loop.peak_sensitivity));
  EXPECT_TRUE(std::isinf(loop.settling_s));
  EXPECT_LT(loop.damping, 0.0);
}

TEST(ClosedLoop, LagOfTheControllerCountsAsDelay) {
  SampledProcess later = known::paper_process();
  ++later.delay_samples;
  const ClosedLoop lagged = close_loop(known::paper_process(), known::law(0.15, 0.15, 1), 1.0);
  const ClosedLoop delayed = close_loop(later, known::law(0.15, 0.15), 1.0);
  EXPECT_DOUBLE_EQ(lagged.peak_sensitivity, delayed.peak_sensitivity);
  EXPECT_DOUBLE_EQ(lagged.damping, delayed.damping);
}

TEST(ClosedLoop, CoarserGridKeepsLongDelays) {
  // 60 samples of delay are computed every three.
  const ProcessFit fit{false, 1.0, 90.0, 0.0, 60.0};
  const ControllerLaw law = known::law(0.75, 0.75 / 90.0);
  const ClosedLoop coarse = close_loop(fit, law, 1.0);
  const ClosedLoop exact = close_loop(sample_process(fit, 1.0), law, 1.0);
  EXPECT_NEAR(coarse.peak_sensitivity / exact.peak_sensitivity, 1.0, 0.05);
  EXPECT_NEAR(coarse.settling_s / exact.settling_s, 1.0, 0.1);
  EXPECT_DOUBLE_EQ(coarse.integral_time_s, 90.0);
}

TEST(ClosedLoop, PureIntegralActionIsNotReportedAsNone) {
  const ClosedLoop loop =
      close_loop(ProcessFit{false, 1.0, 0.0, 0.0, 1.0}, known::law(0.0, 0.3), 1.0);
  EXPECT_GT(loop.integral_time_s, 0.0);
  EXPECT_LT(loop.integral_time_s, 0.1);
}

TEST(ClosedLoop, IntervalHasToBePositive) {
  EXPECT_THROW((void)close_loop(kIntegrator, known::law(0.1, 0.0), 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::model
