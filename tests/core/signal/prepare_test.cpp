#include "core/signal/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/core/signal/archives.hpp"

namespace loopscope::core::signal {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A well-behaved loop: every series recorded and moving.
LoopWindow healthy_window(std::size_t size = 1000) {
  LoopWindow window;
  window.op_range = OpRange{};
  for (std::size_t k = 0; k < size; ++k) {
    const auto t = static_cast<double>(k);
    window.sp.push_back(50.0);
    window.pv.push_back(50.0 + std::sin(0.3 * t) + 0.01 * std::cos(7.0 * t));
    window.op.push_back(40.0 + std::cos(0.3 * t));
  }
  return window;
}

TEST(Prepare, ErrorIsSetpointMinusProcessVariable) {
  const LoopWindow window = healthy_window();
  const PreparedLoop loop = prepare(window, {});
  EXPECT_TRUE(loop.quality.usable) << loop.quality.reason;
  EXPECT_TRUE(loop.quality.flags.empty());
  EXPECT_DOUBLE_EQ(loop.error[17], window.sp[17] - window.pv[17]);
  EXPECT_EQ(*loop.quality.missing_fraction, 0.0);
}

TEST(Prepare, WithoutASetpointTheMeanStandsIn) {
  LoopWindow window = healthy_window();
  window.sp.clear();
  const PreparedLoop loop = prepare(window, {});
  EXPECT_THAT(loop.quality.flags, Contains("sp_missing"));
  double sum = 0.0;
  for (const double e : loop.error) sum += e;
  EXPECT_NEAR(sum, 0.0, 1e-9);
}

TEST(Prepare, OnlyTheLastSamplesCount) {
  LoopWindow window = healthy_window(5000);
  const PreparedLoop loop = prepare(window, {});
  EXPECT_EQ(loop.error.size(), 4096U);
  EXPECT_EQ(loop.pv.back(), window.pv.back());
  EXPECT_EQ(loop.pv.front(), window.pv[5000 - 4096]);
}

TEST(Prepare, ShortGapsAreBridgedLongOnesStayMissing) {
  LoopWindow window = healthy_window();
  window.pv[10] = window.pv[11] = kMissing;
  window.pv[20] = window.pv[21] = window.pv[22] = kMissing;
  const PreparedLoop loop = prepare(window, {});
  EXPECT_NEAR(loop.pv[10], window.pv[9] + (window.pv[12] - window.pv[9]) / 3.0, 1e-12);
  EXPECT_TRUE(std::isnan(loop.pv[21]) && std::isnan(loop.error[21]));
  EXPECT_NEAR(*loop.quality.missing_fraction, 0.005, 1e-12);
}

TEST(Prepare, InfinityCountsAsMissing) {
  LoopWindow window = healthy_window();
  for (std::size_t k = 100; k < 110; ++k) window.pv[k] = HUGE_VAL;
  EXPECT_NEAR(*prepare(window, {}).quality.missing_fraction, 0.01, 1e-12);
}

TEST(Prepare, ValuesThatNoQuantityHasCountAsMissing) {
  LoopWindow window = healthy_window();
  for (std::size_t k = 100; k < 110; ++k) {
    window.pv[k] = 1e300;
    window.op[k] = -std::numeric_limits<double>::max();
  }
  const PreparedLoop loop = prepare(window, {});
  EXPECT_NEAR(*loop.quality.missing_fraction, 0.01, 1e-12);
  EXPECT_TRUE(std::isnan(loop.op_percent[105]));
  EXPECT_EQ(*loop.quality.saturated_fraction, 0.0);
}

TEST(Prepare, TooFewSamplesAreNotJudged) {
  const PreparedLoop loop = prepare(healthy_window(511), {});
  EXPECT_FALSE(loop.quality.usable);
  EXPECT_THAT(loop.quality.reason, HasSubstr("511 usable samples"));
  EXPECT_TRUE(prepare(healthy_window(512), {}).quality.usable);
}

TEST(Prepare, AnEmptyWindowIsNotJudged) {
  const PreparedLoop loop = prepare({}, {});
  EXPECT_FALSE(loop.quality.usable);
  EXPECT_EQ(*loop.quality.missing_fraction, 1.0);
}

TEST(Prepare, TooMuchMissingIsNotJudged) {
  LoopWindow window = healthy_window(2000);
  for (std::size_t k = 0; k < 900; ++k) window.pv[k] = kMissing;
  EXPECT_THAT(prepare(window, {}).quality.reason, HasSubstr("45 % of the pv samples"));
}

TEST(Prepare, AConstantProcessVariableIsNotJudged) {
  LoopWindow window = healthy_window();
  for (double& v : window.pv) v = 0.1 + 0.2;
  window.pv[5] = 0.3;  // differs from 0.1 + 0.2 in the last place only
  const PreparedLoop loop = prepare(window, {});
  EXPECT_EQ(loop.quality.reason, "pv is constant");
  EXPECT_THAT(loop.quality.flags, Contains("pv_constant"));
}

TEST(Prepare, AConstantOutputIsAFlagNotAnError) {
  LoopWindow window = healthy_window();
  window.op.assign(window.size(), 42.0);
  const PreparedLoop loop = prepare(window, {});
  EXPECT_TRUE(loop.quality.usable);
  EXPECT_FALSE(loop.op_moves);
  EXPECT_THAT(loop.quality.flags, Contains("op_constant"));
}

TEST(Prepare, AMissingOutputIsAFlagNotAnError) {
  LoopWindow window = healthy_window();
  window.op.clear();
  EXPECT_THAT(prepare(window, {}).quality.flags, Contains("op_missing"));
  EXPECT_TRUE(prepare(window, {}).quality.usable);
}

TEST(Prepare, OutputOutsideZeroToHundredHasNoKnownRange) {
  LoopWindow window = healthy_window();
  window.op_range.reset();
  for (double& v : window.op) v += 350.0;
  const PreparedLoop unknown = prepare(window, {});
  EXPECT_THAT(unknown.quality.flags, Contains("op_range_unknown"));
  EXPECT_EQ(unknown.op_percent, window.op);
  EXPECT_FALSE(unknown.quality.saturated_fraction.has_value());
  window.op_range = OpRange{300.0, 500.0};
  const PreparedLoop known = prepare(window, {});
  EXPECT_THAT(known.quality.flags, Not(Contains("op_range_unknown")));
  EXPECT_DOUBLE_EQ(known.op_percent[3], (window.op[3] - 300.0) / 2.0);
}

TEST(Prepare, TimeAtALimitIsMeasured) {
  LoopWindow window = healthy_window();
  for (std::size_t k = 0; k < 250; ++k) window.op[k] = k % 2 == 0 ? 100.0 : 0.2;
  EXPECT_NEAR(*prepare(window, {}).quality.saturated_fraction, 0.25, 1e-12);
}

TEST(Prepare, TimeAtAnInferredLimitCountsWhereItIsHeldUnderALastingError) {
  LoopWindow window = healthy_window();
  window.op_range.reset();
  for (std::size_t k = 0; k < 250; ++k) window.op[k] = k % 2 == 0 ? 100.0 : 99.6;
  EXPECT_EQ(*prepare(window, {}).quality.saturated_fraction, 0.0) << "not held";
  for (std::size_t k = 0; k < 250; ++k) window.op[k] = 100.0;
  EXPECT_EQ(*prepare(window, {}).quality.saturated_fraction, 0.0) << "the error comes and goes";
  for (std::size_t k = 0; k < 250; ++k) window.sp[k] = 60.0;
  EXPECT_NEAR(*prepare(window, {}).quality.saturated_fraction, 0.25, 1e-12);
  EXPECT_THAT(prepare(window, {}).quality.flags, Contains("op_range_inferred"));
}

TEST(Prepare, AFrozenProcessVariableIsFlagged) {
  LoopWindow window = healthy_window();
  for (std::size_t k = 100; k < 420; ++k) window.pv[k] = 50.5;
  const PreparedLoop loop = prepare(window, {});
  EXPECT_THAT(loop.quality.flags, Contains("pv_frozen"));
  EXPECT_NEAR(*loop.quality.frozen_fraction, 0.32, 1e-12);
  EXPECT_TRUE(loop.quality.enough);
}

TEST(Prepare, WhatWasDiscardedIsNotCalledMissing) {
  LoopWindow window = healthy_window(2000);
  for (std::size_t k = 300; k < window.size(); ++k) window.pv[k] = 50.5;
  const PreparedLoop loop = prepare(window, {});
  EXPECT_EQ(*loop.quality.missing_fraction, 0.0);
  EXPECT_TRUE(loop.quality.enough);
  EXPECT_THAT(loop.quality.reason, Not(HasSubstr("missing")));
}

TEST(Prepare, WhatStandsStillIsNotCalledMissingWhateverTheArchive) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  LoopWindow window = healthy_window(4096);
  double value = 0.0;
  for (double& pv : window.pv) pv = 50.0 + (value = 0.8 * value + 0.6 * normal(random));
  Samples on_grid = window.pv;
  for (double& pv : on_grid) pv = std::round(pv);
  const Samples banded = held_between(window.pv, keep_one_in(2.0, window.pv, keep_dead_band));
  const Samples lined = lines_between(window.pv, keep_one_in(2.0, window.pv, keep_swinging_door));
  for (const Samples& alive : {window.pv, on_grid, banded, lined}) {
    for (const std::size_t from : {3500U, 2500U, 2000U, 1000U, 400U}) {
      window.pv = alive;
      std::fill(window.pv.begin() + static_cast<std::ptrdiff_t>(from), window.pv.end(), 52.0);
      const PreparedLoop loop = prepare(window, {});
      EXPECT_EQ(*loop.quality.missing_fraction, 0.0) << from;
      EXPECT_TRUE(loop.quality.enough) << from;
      EXPECT_THAT(loop.quality.flags, Contains("pv_dead")) << from;
    }
  }
}

TEST(Prepare, AProcessVariableRenewedSeldomIsFlaggedWithItsFactor) {
  LoopWindow window = healthy_window(1200);
  for (std::size_t k = 0; k < window.size(); ++k) window.pv[k] = window.pv[k - k % 12];
  const PreparedLoop loop = prepare(window, {});
  EXPECT_THAT(loop.quality.flags, Contains("pv_held"));
  EXPECT_NEAR(*loop.quality.compression_factor, 12.0, 0.2);
  EXPECT_DOUBLE_EQ(*prepare(healthy_window(), {}).quality.compression_factor, 1.0);
}

TEST(Prepare, ACoarseGridIsFlaggedWithItsFactor) {
  LoopWindow window = healthy_window();
  for (double& v : window.pv) v = std::round(v);
  const PreparedLoop loop = prepare(window, {});
  EXPECT_THAT(loop.quality.flags, Contains("pv_quantised"));
  EXPECT_GT(*loop.quality.quantisation_factor, 1.0);
}

TEST(Prepare, ASpikeIsBridgedAndFlagged) {
  LoopWindow window = healthy_window();
  window.pv[500] += 40.0;
  const PreparedLoop loop = prepare(window, {});
  EXPECT_THAT(loop.quality.flags, Contains("pv_spikes"));
  EXPECT_NEAR(loop.pv[500], 0.5 * (window.pv[499] + window.pv[501]), 1e-9);
}

TEST(Prepare, AProcessVariableFarFromItsSetpointIsFlagged) {
  LoopWindow window = healthy_window();
  window.sp.assign(window.size(), 20.0);
  EXPECT_THAT(prepare(window, {}).quality.flags, Contains("sp_not_followed"));
}

TEST(Prepare, SamplesInManualAreNoControlError) {
  LoopWindow window = healthy_window();
  window.mode.assign(window.size(), ControlMode::automatic);
  window.mode[300] = ControlMode::manual;
  EXPECT_TRUE(std::isnan(prepare(window, {}).error[300]));
  EXPECT_FALSE(std::isnan(prepare(window, {}).error[301]));
}

TEST(Prepare, ASetpointThatAlwaysMovesIsFlagged) {
  LoopWindow window = healthy_window();
  for (std::size_t k = 0; k < window.size(); ++k) window.sp[k] += 0.01 * static_cast<double>(k % 7);
  EXPECT_THAT(prepare(window, {}).quality.flags, Contains("sp_moving"));
}

TEST(Prepare, OfAControllerMostlyInManualTheWholeErrorIsSeen) {
  LoopWindow window = healthy_window();
  window.mode.assign(window.size(), ControlMode::automatic);
  EXPECT_TRUE(prepare(window, {}).quality.usable);
  for (std::size_t k = 0; k < 600; ++k) window.mode[k] = ControlMode::manual;
  const PreparedLoop loop = prepare(window, {});
  EXPECT_TRUE(loop.quality.usable);
  EXPECT_FALSE(loop.control.controlling());
  EXPECT_FALSE(std::isnan(loop.error[300]));
  window.mode.assign(window.size(), ControlMode::unknown);
  EXPECT_TRUE(prepare(window, {}).quality.usable);
}

TEST(Prepare, SeriesOfDifferentLengthsAreAFault) {
  LoopWindow window = healthy_window();
  window.op.pop_back();
  EXPECT_THROW(static_cast<void>(prepare(window, {})), std::invalid_argument);
  window = healthy_window();
  window.pv_rows = window.pv;
  window.pv_rows.pop_back();
  EXPECT_THROW(static_cast<void>(prepare(window, {})), std::invalid_argument);
}

TEST(Prepare, AnIntervalThatIsNoTimeIsAFault) {
  LoopWindow window = healthy_window();
  for (const double interval : {0.0, -1.0, HUGE_VAL, kMissing}) {
    window.sample_interval_s = interval;
    EXPECT_THROW(static_cast<void>(prepare(window, {})), std::invalid_argument) << interval;
  }
}

TEST(Prepare, OneSampleInSoManyIsJudgedOrRefusedButNeverAFault) {
  for (std::size_t every = 2; every <= 9; ++every) {
    LoopWindow window = healthy_window(4096);
    for (std::size_t k = 0; k < window.pv.size(); ++k) {
      if (k % every != 0) window.pv[k] = kMissing;
    }
    const PreparedLoop loop = prepare(window, {});
    if (every > 4) {
      ASSERT_FALSE(loop.quality.refusals.empty()) << every;
      EXPECT_THAT(loop.quality.refusals.front(), HasSubstr(std::to_string(every) + "."));
    }
  }
}

}  // namespace
}  // namespace loopscope::core::signal
