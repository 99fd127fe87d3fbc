// What the second look sees of slow oscillations and the first does not. The tables of MEASURED.md
// are what these tests print.

#include "core/hos/slow_look.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/hos/slow/decimate.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/support/long_run.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::kTurn;
constexpr std::size_t kFirstSeed = 9001;
/// Per signal; LOOPSCOPE_RECORDS=1000 gives MEASURED.md's tables.
constexpr std::size_t kSlowRecords = 40;

using tests::sawtooth;
using tests::sine;
using tests::square;
using tests::triangle;

// Shapes of variance 1.
double unequal_square(double turn) {  // 30 % up
  return turn < 0.3 ? std::sqrt(7.0 / 3.0) : -std::sqrt(3.0 / 7.0);
}
double second_harmonic(double turn) {  // 30 % of the fundamental
  return std::sqrt(2.0 / 1.09) * (std::cos(kTurn * turn) + 0.3 * std::cos(2.0 * kTurn * turn));
}

/// Poles radius exp(+- j 2 pi / period), driven by white Gaussian noise.
std::vector<double> resonance(std::uint64_t seed, double period, double radius,
                              std::size_t length) {
  constexpr std::size_t kSettling = 4000;
  std::vector<double> x = tests::white_noise(seed, length + kSettling);
  for (std::size_t k = 2; k < x.size(); ++k) {
    x[k] += 2.0 * radius * std::cos(kTurn / period) * x[k - 1] - radius * radius * x[k - 2];
  }
  return {x.begin() + kSettling, x.end()};
}

struct Wave {
  const char* name;
  double (*shape)(double turn);
};

std::vector<double> last_of(const std::vector<double>& x, std::size_t count) {
  return {x.end() - static_cast<std::ptrdiff_t>(std::min(count, x.size())), x.end()};
}

/// The span that the daemon would read: four windows at most.
std::size_t span_for(double period) {
  return std::clamp(slow_span(period, {}), tests::kRecord, 4 * tests::kRecord);
}

struct Spread {
  double low, median, high;  ///< 5th, 50th, 95th percentile
};

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
  };
  return {at(0.05), at(0.5), at(0.95)};
}

/// NGI of the first look at the last window and of the second at the whole span.
struct BothLooks {
  Spread first, slow;
  double k_mean = 0.0;    ///< K times the mean squared bicoherence of the slow look, on average
  double segments = 0.0;  ///< of the slow look, on average
  double coupled = 0.0;   ///< share of records in which the slow look reports a coupling
};

BothLooks measure(const char* name, double period,
                  const std::function<std::vector<double>(std::uint64_t)>& draw) {
  std::vector<double> first, slow;
  BothLooks both;
  const std::size_t records = loopscope::tests::all_records(kSlowRecords);
  const auto share = 1.0 / static_cast<double>(records);
  for (std::size_t seed = kFirstSeed; seed < kFirstSeed + records; ++seed) {
    const std::vector<double> x = draw(seed);
    const auto look = look_slowly(x, period, {});
    first.push_back(analyse(last_of(x, tests::kRecord), {})->ngi);
    slow.push_back(look.value().result.ngi);
    both.segments += share * static_cast<double>(look->result.segments);
    both.k_mean += share * static_cast<double>(look->result.segments) * look->result.mean_bic2;
    both.coupled += look->result.coupling == Coupling::none_found ? 0.0 : share;
  }
  both.first = spread_of(first);
  both.slow = spread_of(slow);
  std::printf(
      "| %-24s | %3.0f | %7.4f [%7.4f .. %7.4f] | %7.4f [%7.4f .. %7.4f] | %3.0f | %5.2f | %3.0f "
      "%% |\n",
      name, period, both.first.median, both.first.low, both.first.high, both.slow.median,
      both.slow.low, both.slow.high, both.segments, both.k_mean, 100.0 * both.coupled);
  return both;
}

BothLooks measure_wave(const Wave& wave, double period) {
  return measure(wave.name, period, [&](std::uint64_t seed) {
    return tests::jittered_wave(seed, period, span_for(period), wave.shape);
  });
}

class SlowWaves : public testing::TestWithParam<double> {};

/// Coupled harmonics that lie within one bin of a segment of 64.
TEST_P(SlowWaves, TheSecondLookSeesWhatTheFirstCannotResolve) {
  for (const Wave& wave :
       {Wave{"second harmonic 30 %", second_harmonic}, Wave{"square, 30 % up", unequal_square}}) {
    const BothLooks both = measure_wave(wave, GetParam());
    EXPECT_GT(both.slow.low, 0.03) << wave.name;
    EXPECT_GT(both.slow.low, 10.0 * both.first.high) << wave.name;
  }
}

/// A sawtooth's steps all go one way: the first look sees that as skewness.
TEST_P(SlowWaves, BothLooksSeeASawtooth) {
  const BothLooks both = measure_wave({"sawtooth", sawtooth}, GetParam());
  EXPECT_GT(both.first.low, 0.03);
  EXPECT_GT(both.slow.low, 1.5 * both.first.high);
}

TEST_P(SlowWaves, OddSymmetricOnesStayInvisible) {
  for (const Wave& wave :
       {Wave{"sine", sine}, Wave{"square", square}, Wave{"triangle", triangle}}) {
    EXPECT_LT(measure_wave(wave, GetParam()).slow.high, 0.03) << wave.name;
  }
}

/// Nothing is coupled here. K counts segments that overlap by three quarters as if they were
/// independent: the mean is 1.4 to 1.6 / K and NGI above 0, so that only p-values may judge it.
TEST_P(SlowWaves, LinearGaussianSignalsShowTheOverlapAndNothingElse) {
  const double period = GetParam();
  const auto check = [](const BothLooks& both) {
    EXPECT_NEAR(both.k_mean, 1.5, 0.25);
    EXPECT_LT(both.slow.high, 0.03);
  };
  for (const double radius : {0.99, 0.995}) {
    check(measure(
        radius < 0.992 ? "resonance, pole 0.99" : "resonance, pole 0.995", period,
        [=](std::uint64_t seed) { return resonance(seed, period, radius, span_for(period)); }));
  }
  check(measure("white", period,
                [=](std::uint64_t seed) { return tests::white_noise(seed, span_for(period)); }));
}

INSTANTIATE_TEST_SUITE_P(Periods, SlowWaves, testing::Values(100.0, 200.0, 400.0),
                         [](const auto& tested) {
                           return std::to_string(static_cast<int>(tested.param));
                         });

TEST(SlowLook, IsNeededWhereASegmentHoldsFewerThanOneAndAHalfCycles) {
  EXPECT_FALSE(needs_slow_look(20.0, {}));
  EXPECT_FALSE(needs_slow_look(64.0 / 1.5, {}));
  EXPECT_TRUE(needs_slow_look(43.0, {}));
  EXPECT_FALSE(needs_slow_look(43.0, {.segment_length = 128}));
  EXPECT_FALSE(needs_slow_look(std::numeric_limits<double>::infinity(), {}));
  EXPECT_FALSE(needs_slow_look(std::nan(""), {}));
  EXPECT_EQ(slow_span(20.0, {}), 0U);
}

/// Every period that a window of 4096 samples can show.
TEST(SlowLook, ItsSpanGivesSixtySegmentsOfTwoToThreeCycles) {
  for (double period = 43.0; period <= 820.0; period += 7.0) {
    const std::size_t span = slow_span(period, {});
    const auto look = look_slowly(tests::white_noise(1, span), period, {});
    ASSERT_TRUE(look) << period;
    EXPECT_EQ(look->result.segments, 60U) << period;
    EXPECT_EQ(look->samples, span);
    EXPECT_GE(static_cast<double>(span), 25.0 * period);
    const double cycles = 32.0 * static_cast<double>(look->decimation) / period;
    EXPECT_GE(cycles, 2.3) << period;
    EXPECT_LE(cycles, 3.0) << period;
  }
}

TEST(SlowLook, PeaksLieAtTheHarmonics) {
  constexpr double kPeriod = 204.0;
  const std::vector<double> x =
      tests::jittered_wave(4, kPeriod, slow_span(kPeriod, {}), second_harmonic);
  const auto look = look_slowly(x, kPeriod, {});
  ASSERT_TRUE(look && !look->result.peaks.empty());
  EXPECT_EQ(look->decimation, 17U);
  EXPECT_NEAR(look->result.peaks[0].f1, 1.0 / 12.0, 1.0 / 64.0);
  EXPECT_NEAR(look->result.peaks[0].f2, 1.0 / 12.0, 1.0 / 64.0);
}

TEST(SlowLook, GapsCostSegmentsAndRaiseNothing) {
  double k_mean = 0.0;
  constexpr int kRecords = 40;
  for (std::uint64_t seed = 1; seed <= kRecords; ++seed) {
    std::vector<double> x = tests::white_noise(seed, slow_span(200.0, {}));
    for (const std::size_t start : {1500U, 4000U, 6500U}) {
      std::fill_n(x.begin() + static_cast<std::ptrdiff_t>(start), 300, std::nan(""));
    }
    const auto look = look_slowly(x, 200.0, {});
    ASSERT_TRUE(look.has_value());
    EXPECT_LT(look->result.segments, 50U);
    k_mean += static_cast<double>(look->result.segments) * look->result.mean_bic2 / kRecords;
  }
  EXPECT_NEAR(k_mean, 1.5, 0.25);
}

TEST(SlowLook, NothingToSay) {
  const std::vector<double> x = tests::white_noise(1, tests::kRecord);
  EXPECT_FALSE(look_slowly(x, 20.0, {}));
  // 15 segments take 32 + 14 * 8 kept samples behind a low-pass of 24.
  const std::size_t fewest = (32 + 14 * 8 + 23) * 17 + 1;
  EXPECT_TRUE(look_slowly(last_of(x, fewest), 204.0, {}));
  EXPECT_FALSE(look_slowly(last_of(x, fewest - 1), 204.0, {}));
  EXPECT_FALSE(look_slowly(std::vector<double>(4096, 0.1), 200.0, {}));
  EXPECT_FALSE(look_slowly(std::vector<double>(4096, std::nan("")), 200.0, {}));
  EXPECT_FALSE(look_slowly({}, 200.0, {}));
  EXPECT_THROW((void)look_slowly(x, 20.0, {.dft_length = 32}), std::invalid_argument);
}

TEST(SlowLook, OtherSettingsAreThoseGiven) {
  const Settings slow = slow_settings({.window = WindowShape::hamming, .alpha = 0.01});
  EXPECT_EQ(slow.segment_length, 32U);
  EXPECT_EQ(slow.dft_length, 64U);
  EXPECT_EQ(slow.overlap, 0.75);
  EXPECT_EQ(slow.window, WindowShape::hamming);
  EXPECT_EQ(slow.alpha, 0.01);
  EXPECT_NO_THROW(validate(slow));
}

}  // namespace
}  // namespace loopscope::core::hos
