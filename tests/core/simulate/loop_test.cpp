#include "core/simulate/loop.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <stdexcept>

#include "core/simulate/paper_loops.hpp"

namespace loopscope::core::simulate {
namespace {

double standard_deviation(const std::vector<double>& values) {
  double mean = 0.0;
  double square = 0.0;
  for (const double value : values) {
    mean += value / static_cast<double>(values.size());
    square += value * value / static_cast<double>(values.size());
  }
  return std::sqrt(square - mean * mean);
}

double still_share(const std::vector<double>& values) {
  std::size_t still = 0;
  for (std::size_t k = 1; k < values.size(); ++k) {
    still += values[k] == values[k - 1] ? 1U : 0U;
  }
  return static_cast<double>(still) / static_cast<double>(values.size() - 1);
}

/// Lag of the autocorrelation's highest peak after its first zero.
std::size_t period(const std::vector<double>& error) {
  std::vector<double> correlation(200, 0.0);
  for (std::size_t lag = 0; lag < correlation.size(); ++lag) {
    for (std::size_t k = lag; k < error.size(); ++k) {
      correlation[lag] += error[k] * error[k - lag];
    }
  }
  const auto zero = std::ranges::find_if(correlation, [](double c) { return c < 0.0; });
  return static_cast<std::size_t>(std::max_element(zero, correlation.end()) - correlation.begin());
}

double amplitude_at(const std::vector<double>& signal, double frequency) {
  double cosine = 0.0;
  double sine = 0.0;
  for (std::size_t k = 0; k < signal.size(); ++k) {
    const double angle = 2.0 * std::numbers::pi * frequency * static_cast<double>(k);
    cosine += signal[k] * std::cos(angle);
    sine += signal[k] * std::sin(angle);
  }
  return 2.0 * std::hypot(cosine, sine) / static_cast<double>(signal.size());
}

TEST(Process, StepResponseIsThatOfEquation20) {
  Process process(ProcessModel{});
  std::vector<double> response;
  for (int k = 0; k < 100; ++k) {
    response.push_back(process.output());
    process.advance(1.0);
  }
  EXPECT_EQ(response[2], 0.0);
  EXPECT_DOUBLE_EQ(response[3], 1.45);
  EXPECT_DOUBLE_EQ(response[4], 0.8 * 1.45 + 0.45);
  EXPECT_NEAR(response[99], 0.45 / 0.2, 1e-6);
}

TEST(Loop, SameSeedSameRecordBitForBit) {
  const LoopSettings settings = sticking_loop(StictionLaw::kano);
  const LoopRecord first = simulate_loop(settings, 5);
  const LoopRecord second = simulate_loop(settings, 5);
  EXPECT_EQ(first.pv, second.pv);
  EXPECT_EQ(first.op, second.op);
  EXPECT_EQ(first.mv, second.mv);
  EXPECT_NE(first.pv, simulate_loop(settings, 6).pv);
}

TEST(Loop, RestsAtTheOperatingPointWhenNothingDisturbsIt) {
  LoopSettings settings;
  settings.load.step_std = 0.0;
  const LoopRecord record = simulate_loop(settings, 1);
  EXPECT_EQ(record.pv, std::vector<double>(4096, 50.0));
  EXPECT_EQ(record.mv, std::vector<double>(4096, 50.0));
}

TEST(Loop, KeepsTheLastSamplesOfSixThousand) {
  const LoopSettings settings;
  EXPECT_EQ(settings.discarded_samples + settings.recorded_samples, 6000U);
  EXPECT_EQ(simulate_loop(settings, 1).pv.size(), 4096U);
}

TEST(Loop, IntegralActionRemovesASetpointStepAndALoadStep) {
  LoopSettings settings;
  settings.load.step_std = 0.0;
  settings.setpoint_moves = {{.at_sample = 2000, .size = 10.0}};
  settings.effects = {LoadStep{.at_s = 1000.0, .size = -5.0}};
  const LoopRecord record = simulate_loop(settings, 1);
  EXPECT_NEAR(record.pv.back(), 60.0, 1e-9);
  EXPECT_NEAR(record.op.back(), 50.0 + 15.0 / 2.25, 1e-9);
}

TEST(Loop, StaysWithinTheControllersLimits) {
  LoopSettings settings;
  settings.effects = {ExternalOscillation{.period_s = 400.0, .amplitude = 500.0}};
  const LoopRecord record = simulate_loop(settings, 1);
  EXPECT_EQ(std::ranges::min(record.op), 0.0);
  EXPECT_EQ(std::ranges::max(record.op), 100.0);
}

TEST(PaperLoops, AreAllStable) {
  for (const LoopSettings& settings :
       {well_tuned_loop(), printed_integral_loop(), excessive_integral_loop(),
        outside_sinusoid_loop(), sticking_loop(StictionLaw::choudhury)}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const std::vector<double> error = control_error(simulate_loop(settings, seed));
      const std::vector<double> late(error.begin() + 2048, error.end());
      EXPECT_LT(standard_deviation(late), 3.0);
    }
  }
}

TEST(PaperLoops, OnlyTheExcessiveReadingOf52Oscillates) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const double well = standard_deviation(control_error(simulate_loop(well_tuned_loop(), seed)));
    const double printed =
        standard_deviation(control_error(simulate_loop(printed_integral_loop(), seed)));
    const double excessive =
        standard_deviation(control_error(simulate_loop(excessive_integral_loop(), seed)));
    EXPECT_LT(printed, 1.4 * well);
    EXPECT_GT(excessive, 2.5 * well);
  }
}

TEST(PaperLoops, SinusoidOf53ShowsAtPeriod100) {
  // The noise's line amplitude at one frequency is about error_std * 2 / sqrt(4096) = 0.014.
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const LoopRecord record = simulate_loop(outside_sinusoid_loop(), seed);
    const LoopRecord without = simulate_loop(well_tuned_loop(), seed);
    EXPECT_GT(amplitude_at(control_error(record), 0.01), 0.2);
    EXPECT_LT(amplitude_at(control_error(without), 0.01), 0.1);
  }
}

TEST(PaperLoops, StictionOf54MakesALimitCycleOfAStickingValve) {
  for (const StictionLaw law : {StictionLaw::choudhury, StictionLaw::kano}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const LoopRecord record = simulate_loop(sticking_loop(law), seed);
      const std::vector<double> error = control_error(record);
      EXPECT_GT(period(error), 10U);
      EXPECT_GT(still_share(record.mv), 0.5);
      EXPECT_GT(standard_deviation(error),
                2.0 * standard_deviation(control_error(simulate_loop(well_tuned_loop(), seed))));
    }
  }
}

TEST(PaperLoops, TheTwoValveLawsAreDifferentValves) {
  const LoopRecord printed = simulate_loop(sticking_loop(StictionLaw::choudhury), 1);
  const LoopRecord kano = simulate_loop(sticking_loop(StictionLaw::kano), 1);
  EXPECT_NE(printed.mv, kano.mv);
}

TEST(Loop, RefusesSettingsOutOfRange) {
  LoopSettings no_delay;
  no_delay.process.delay_samples = 0;
  LoopSettings growing_load;
  growing_load.load.memory = 1.1;
  LoopSettings bad_effect;
  bad_effect.effects = {ValveStiction{.stickband_percent = 1.0, .slip_jump_percent = 2.0}};
  for (const LoopSettings& settings : {no_delay, growing_load, bad_effect}) {
    EXPECT_THROW((void)simulate_loop(settings, 1), std::invalid_argument);
  }
}

}  // namespace
}  // namespace loopscope::core::simulate
