#include "core/hos/coupling/harmonic_test.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/hos/coupling/null_laws.hpp"
#include "core/hos/slow/period.hpp"
#include "core/simulate/coloured_noise.hpp"
#include "core/simulate/disturbances.hpp"
#include "core/simulate/limit_cycle.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/signals.hpp"
#include "tests/support/chance.hpp"
#include "tests/support/long_run.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::hos {
namespace {

using loopscope::tests::four_errors;

using simulate::WaveShape;

using loopscope::tests::kTurn;

std::optional<HarmonicStatistics> statistics_of(const std::vector<double>& signal) {
  const auto period = dominant_period(signal);
  return period ? harmonic_statistics(signal, *period) : std::nullopt;
}

double cubic_p_of(const std::vector<double>& signal) {
  const auto found = statistics_of(signal);
  return found ? p_of_evidence(found->cubic_evidence) : 1.0;
}

/// Both agree to `tolerance`, relative.
void expect_same(const HarmonicStatistics& found, const HarmonicStatistics& before,
                 double tolerance) {
  EXPECT_NEAR(found.quadratic_evidence / before.quadratic_evidence, 1.0, tolerance);
  EXPECT_NEAR(found.cubic_evidence / before.cubic_evidence, 1.0, tolerance);
}

TEST(HosHarmonicTest, DoesNotDependOnScaleSignOrOffset) {
  const auto signal = simulate::limit_cycle(
      {.shape = WaveShape::asymmetric_square, .period_samples = 40.0, .snr_db = 0.0}, 4096, 3);
  const auto before = statistics_of(signal).value();
  for (const double gain : {-1.0, 1e300, 1e-300, 1e9}) {
    const auto found = statistics_of(tests::affine(signal, gain, 0.0));
    ASSERT_TRUE(found.has_value()) << gain;
    EXPECT_NEAR(found->period_samples / before.period_samples, 1.0, 1e-9) << gain;
    expect_same(*found, before, 1e-6);
  }
  expect_same(statistics_of(tests::affine(signal, 1.0, 1000.0)).value(), before, 1e-6);
}

TEST(HosHarmonicTest, DoesNotDependOnTheStartByWholeHops) {
  // Period 40: segments of 70 samples every 17. The same 4000 samples with one hop in front.
  const auto signal = simulate::limit_cycle({.period_samples = 40.0}, 4017, 5);
  const std::vector<double> late(signal.begin() + 17, signal.end());
  auto early = signal;
  std::fill_n(early.begin(), 17, std::nan(""));
  expect_same(harmonic_statistics(late, 40.0).value(), harmonic_statistics(early, 40.0).value(),
              1e-9);
}

TEST(HosHarmonicTest, EachHarmonicIsSeenByItsOwnEvidence) {
  const auto square = statistics_of(simulate::limit_cycle({.period_samples = 40.0}, 4096, 7));
  EXPECT_GT(square->cubic_evidence, 20.0);
  EXPECT_LT(square->quadratic_evidence, 7.0);
  const auto bent = [](double turn) {
    return std::cos(kTurn * turn) + 0.3 * std::cos(2.0 * kTurn * turn);
  };
  const auto second = statistics_of(tests::jittered_wave(7, 40.0, 4096, bent));
  EXPECT_GT(second->quadratic_evidence, 20.0);
  EXPECT_LT(second->cubic_evidence, 7.0);
}

TEST(HosHarmonicTest, SeesWavesOfEveryPeriod) {
  const int records = tests::records(25);
  for (const WaveShape shape : {WaveShape::square, WaveShape::triangle, WaveShape::sawtooth}) {
    for (const double period : {16.0, 30.0, 64.0, 130.0, 400.0}) {
      int seen = 0;
      for (int seed = 1; seed <= records; ++seed) {
        const auto signal = simulate::limit_cycle({.shape = shape, .period_samples = period}, 4096,
                                                  static_cast<std::uint64_t>(seed));
        seen += cubic_p_of(signal) <= 0.05 ? 1 : 0;
      }
      EXPECT_GE(seen, period > 200.0 ? 0.9 * records : 0.95 * records)
          << simulate::name(shape) << ' ' << period;
    }
  }
}

/// Shares of records whose quadratic and cubic evidence lies beyond a level.
struct Sizes {
  double quadratic = 0.0;
  double cubic = 0.0;
};

template <typename Draw>
Sizes sizes(double level, int records, const Draw& draw) {
  Sizes result;
  for (int seed = 1; seed <= records; ++seed) {
    const HarmonicStatistics found = statistics_of(draw(static_cast<std::uint64_t>(seed))).value();
    result.quadratic += p_of_evidence(found.quadratic_evidence) <= level ? 1.0 / records : 0.0;
    result.cubic += p_of_evidence(found.cubic_evidence) <= level ? 1.0 / records : 0.0;
  }
  return result;
}

TEST(HosHarmonicTest, HoldsItsLevelOnLinearNoise) {
  const int records = tests::records(600);
  for (const auto& [name, filter] :
       {std::pair{"white", simulate::real_pole(0.0)},
        std::pair{"random walk", simulate::real_pole(1.0)},
        std::pair{"resonance 20", simulate::resonance(20.0, 0.99)},
        std::pair{"resonance 200", simulate::resonance(200.0, 0.995)}}) {
    for (const auto& [level, most] : {std::pair{0.05, 0.07}, std::pair{0.01, 0.02}}) {
      const Sizes found = sizes(level, records, [&filter](std::uint64_t seed) {
        return simulate::coloured_noise(filter, simulate::Innovation::gaussian, 4096, seed);
      });
      std::printf("| %s | %.0f %% | %.1f %% | %.1f %% |\n", name, 100.0 * level,
                  100.0 * found.quadratic, 100.0 * found.cubic);
      EXPECT_LE(found.quadratic, most + four_errors(most, records)) << name;
      EXPECT_LE(found.cubic, most + four_errors(most, records)) << name;
    }
  }
}

TEST(HosHarmonicTest, ASineAloneIsNotCoupled) {
  const int records = tests::records(200);
  const Sizes found =
      sizes(0.05, records, [](std::uint64_t seed) { return tests::sinusoid_in_noise(seed, 50.0); });
  EXPECT_LE(found.quadratic, 0.07 + four_errors(0.07, records));
  EXPECT_LE(found.cubic, 0.07 + four_errors(0.07, records));
}

/// Given the powers alone 10 and 14 % at period 20: both bands get louder together.
TEST(HosHarmonicTest, HoldsItsLevelWhereTheNoiseGetsLouder) {
  const int records = static_cast<int>(loopscope::tests::all_records(200));
  for (const auto& [share, factor] : {std::pair{0.5, 2.0}, std::pair{0.1, 3.0}}) {
    for (const double period : {20.0, 100.0}) {
      Sizes found;
      for (int seed = 1; seed <= records; ++seed) {
        const auto noise = tests::white_noise(static_cast<std::uint64_t>(seed));
        const auto record = simulate::with_level(noise, 0.5, 0.5 + share, factor);
        const auto statistics = harmonic_statistics(record, period);
        const auto rejected = [&](double evidence) {
          return p_of_evidence(evidence) <= 0.05 ? 1.0 / records : 0.0;
        };
        found.quadratic += rejected(statistics->quadratic_evidence);
        found.cubic += rejected(statistics->cubic_evidence);
      }
      std::printf("| %.0f %% times %.0f, period %.0f | %.1f %% | %.1f %% |\n", 100.0 * share,
                  factor, period, 100.0 * found.quadratic, 100.0 * found.cubic);
      EXPECT_LE(found.quadratic, 0.07 + four_errors(0.07, records)) << period;
      EXPECT_LE(found.cubic, 0.07 + four_errors(0.07, records)) << period;
    }
  }
}

TEST(HosHarmonicTest, HasNothingToSayWithoutSegments) {
  EXPECT_FALSE(harmonic_statistics({}, 40.0).has_value());
  // Four segments of 70 samples every 17.
  EXPECT_FALSE(harmonic_statistics(tests::white_noise(1, 120), 40.0).has_value());
  EXPECT_TRUE(harmonic_statistics(tests::white_noise(1, 121), 40.0).has_value());
  EXPECT_FALSE(harmonic_statistics(std::vector<double>(4096, std::nan("")), 40.0).has_value());
}

}  // namespace
}  // namespace loopscope::core::hos
