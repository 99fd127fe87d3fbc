// How often linear, Gaussian loops are called nonlinear because somebody moves their setpoint, with
// and without the mask. The table of MEASURED.md is what this test prints.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

#include "core/hos/analyse.hpp"
#include "core/signal/order/spread.hpp"
#include "core/signal/prepare.hpp"
#include "core/signal/setpoint_steps.hpp"
#include "core/simulate/paper_loops.hpp"
#include "core/simulate/plant_loops.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/support/chance.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::core::signal {
namespace {

/// Per line; LOOPSCOPE_RECORDS=1000 gives MEASURED.md's table.
constexpr std::size_t kStepRecords = 200;
int records() {
  return static_cast<int>(loopscope::tests::records(kStepRecords));
}

/// A bound that holds for the mean of kStepRecords.
double for_records(double bound) {
  return loopscope::tests::widened(bound, kStepRecords, records());
}

/// Segments of a whole record.
constexpr double kAllSegments = 127.0;

PreparedLoop record_of(const simulate::LoopSettings& settings, int seed) {
  const auto record = simulate::simulate_loop(settings, static_cast<std::uint64_t>(seed));
  LoopWindow window;
  window.sp = record.sp;
  window.pv = record.pv;
  window.op = record.op;
  return prepare(window, {});
}

/// Up, back, down, back by `error_stds` of the loop's own error.
simulate::LoopSettings stepped(simulate::LoopSettings loop, double error_stds, std::size_t every) {
  constexpr double kPattern[] = {1.0, -1.0, -1.0, 1.0};
  constexpr int kAnySeed = 0;
  const double size = error_stds * measure_spread(record_of(loop, kAnySeed).error)->std;
  const std::size_t end = loop.discarded_samples + loop.recorded_samples;
  for (std::size_t at = every; at < end; at += every) {
    const double sign = kPattern[loop.setpoint_moves.size() % 4];
    loop.setpoint_moves.push_back({.at_sample = at, .size = sign * size});
  }
  return loop;
}

/// Shares of the records with NGI above the paper's 0.001, and above 0.001 * 127 / K.
struct Rate {
  double published = 0.0;
  double scaled = 0.0;

  void add(const Samples& error) {
    const auto result = hos::analyse(error, {});
    const double limit = 0.001;
    const double share = 1.0 / records();
    published += result->ngi > limit ? share : 0.0;
    scaled += result->ngi > limit * kAllSegments / double(result->segments) ? share : 0.0;
    segments += share * double(result->segments);
  }
  double segments = 0.0;
};

struct StepRates {
  Rate whole, masked;
  Rate unstepped;  ///< the same noise without steps, the same samples missing
  double masked_fraction = 0.0;
  double residual = 0.0;       ///< rms of what the steps left, in standard deviations
  double kept_variance = 0.0;  ///< of the unstepped error at the samples kept / of all
};

double mean_square(const Samples& samples) {
  const Spread spread = *measure_spread(samples);
  return spread.mean * spread.mean + spread.std * spread.std;
}

Samples difference(const Samples& a, const Samples& b) {
  Samples result(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) result[k] = a[k] - b[k];
  return result;
}

/// The error of a linear loop is what it is without steps plus the answer to the steps: what the
/// mask leaves of the answer, and what it prefers of the noise, can be told apart exactly.
StepRates measure(const simulate::LoopSettings& loop, double error_stds, std::size_t every) {
  const simulate::LoopSettings moved = stepped(loop, error_stds, every);
  StepRates rates;
  double left = 0.0, kept = 0.0, all = 0.0;
  for (int seed = 1; seed <= records(); ++seed) {
    const PreparedLoop record = record_of(moved, seed);
    const Samples alone = record_of(loop, seed).error;
    const ErrorBetweenSteps between = error_between_steps(record);
    const Samples answer = difference(between.error, alone);
    const Samples unstepped = difference(between.error, answer);
    rates.whole.add(record.error);
    rates.masked.add(between.error);
    rates.unstepped.add(unstepped);
    rates.masked_fraction += between.masked_fraction / records();
    left += mean_square(answer);
    kept += mean_square(unstepped);
    all += mean_square(alone);
  }
  rates.residual = std::sqrt(left / all);
  rates.kept_variance = kept / all;
  return rates;
}

void print_head() {
  std::printf("| loop | step | every | whole | masked | unstepped | masked, scaled ");
  std::printf("| unstepped, scaled | K | gone | left | kept |\n");
}

void print(const char* name, double error_stds, std::size_t every, const StepRates& r) {
  std::printf("| %s | %.0f | %zu ", name, error_stds, every);
  for (const double rate : {r.whole.published, r.masked.published, r.unstepped.published,
                            r.masked.scaled, r.unstepped.scaled}) {
    std::printf("| %.1f %% ", 100.0 * rate);
  }
  std::printf("| %.0f | %.0f %% | %.3f | %.3f |\n", r.masked.segments, 100.0 * r.masked_fraction,
              r.residual, r.kept_variance);
}

void check(const char* name, const simulate::LoopSettings& loop) {
  print_head();
  for (const double error_stds : {1.0, 3.0, 10.0}) {
    for (const std::size_t every : {250U, 500U, 1500U}) {
      const StepRates rates = measure(loop, error_stds, every);
      print(name, error_stds, every, rates);
      // Paired records: the difference is far below the binomial spread of either.
      EXPECT_NEAR(rates.masked.published, rates.unstepped.published, for_records(0.03));
      EXPECT_LT(rates.residual, 0.05);
      EXPECT_NEAR(rates.kept_variance, 1.0, for_records(0.01));
      if (error_stds == 10.0) {
        EXPECT_GT(rates.whole.scaled, 3.0 * rates.masked.scaled);
      }
    }
  }
}

TEST(SetpointStepsRates, AFlowLoopIsAsLinearAsWithoutSteps) {
  check("healthy_flow", simulate::healthy_flow({}));
}

TEST(SetpointStepsRates, ThePapersLoopIsAsLinearAsWithoutSteps) {
  check("paper_5_1", simulate::well_tuned_loop());
}

TEST(SetpointStepsRates, ASlowLoopNeedsLongRestsBetweenItsSteps) {
  print_head();
  const simulate::LoopSettings loop = simulate::sluggish_tuning({});
  for (const std::size_t every : {250U, 500U, 1500U}) {
    const StepRates rates = measure(loop, 10.0, every);
    print("sluggish_tuning", 10.0, every, rates);
    if (every == 1500U) {
      EXPECT_NEAR(rates.masked.published, rates.unstepped.published, for_records(0.03));
    }
  }
}

/// A curve that only the moves reach cannot show between them: that is what a fitted model is for.
TEST(SetpointStepsRates, WhatOnlyTheMovesShowIsNotSeenBetweenThem) {
  std::printf("| loop | whole | masked, scaled |\n");
  for (const char* const name : {"worn_valve", "nonlinear_process", "process_gain_change"}) {
    Rate whole, masked;
    for (int seed = 1; seed <= records(); ++seed) {
      const PreparedLoop record = record_of(simulate::scenario_loop(name), seed);
      whole.add(record.error);
      masked.add(error_between_steps(record).error);
    }
    std::printf("| %s | %.1f %% | %.1f %% |\n", name, 100.0 * whole.scaled, 100.0 * masked.scaled);
    EXPECT_LT(masked.scaled, 0.2) << name;
  }
}

}  // namespace
}  // namespace loopscope::core::signal
