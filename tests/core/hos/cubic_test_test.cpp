#include "core/hos/cubic_test.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "core/simulate/coloured_noise.hpp"
#include "core/simulate/limit_cycle.hpp"
#include "tests/core/hos/rejections.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

using simulate::WaveShape;

double p_of(const std::vector<double>& signal) {
  const auto found = cubic_statistics(signal);
  return found ? std::exp(-found->evidence) : 1.0;
}

TEST(HosCubicTest, DoesNotDependOnScaleSignOrOffset) {
  const auto signal = simulate::limit_cycle({.period_samples = 40.0, .snr_db = 0.0}, 4096, 3);
  const auto before = cubic_statistics(signal).value();
  for (const double gain : {-1.0, 1e300, 1e-300, 1e9}) {
    const auto found = cubic_statistics(tests::affine(signal, gain, 0.0));
    ASSERT_TRUE(found.has_value()) << gain;
    EXPECT_NEAR(found->period_samples / before.period_samples, 1.0, 1e-9) << gain;
    EXPECT_NEAR(found->evidence / before.evidence, 1.0, 1e-6) << gain;
  }
  const auto shifted = cubic_statistics(tests::affine(signal, 1.0, 1000.0)).value();
  EXPECT_NEAR(shifted.evidence / before.evidence, 1.0, 1e-6);
}

TEST(HosCubicTest, DoesNotDependOnTheStartByWholeHops) {
  // Period 40: segments of 80 samples every 20. The same 4000 samples with one hop in front.
  const auto signal = simulate::limit_cycle({.period_samples = 40.0}, 4020, 5);
  const std::vector<double> late(signal.begin() + 20, signal.end());
  auto early = signal;
  std::fill_n(early.begin(), 20, std::nan(""));
  EXPECT_NEAR(cubic_statistics(late, 40.0)->evidence / cubic_statistics(early, 40.0)->evidence, 1.0,
              1e-9);
}

TEST(HosCubicTest, SeesWavesOfEveryPeriod) {
  const int records = tests::records_or(25);
  for (const WaveShape shape : {WaveShape::square, WaveShape::triangle, WaveShape::sawtooth}) {
    for (const double period : {16.0, 30.0, 64.0, 130.0, 400.0}) {
      int seen = 0;
      for (int seed = 1; seed <= records; ++seed) {
        const auto signal = simulate::limit_cycle({.shape = shape, .period_samples = period}, 4096,
                                                  static_cast<std::uint64_t>(seed));
        seen += p_of(signal) <= 0.05 ? 1 : 0;
      }
      EXPECT_GE(seen, period > 200.0 ? 0.9 * records : 0.95 * records)
          << simulate::name(shape) << ' ' << period;
    }
  }
}

TEST(HosCubicTest, HoldsItsLevelOnLinearNoise) {
  struct Row {
    const char* name;
    simulate::AllPole filter;
  };
  const int records = tests::records_or(600);
  for (const Row& row :
       {Row{"white", simulate::real_pole(0.0)}, Row{"random walk", simulate::real_pole(1.0)},
        Row{"resonance 20", simulate::resonance(20.0, 0.99)},
        Row{"resonance 200", simulate::resonance(200.0, 0.995)}}) {
    int five = 0;
    int one = 0;
    for (int seed = 1; seed <= records; ++seed) {
      const double p = p_of(simulate::coloured_noise(row.filter, simulate::Innovation::gaussian,
                                                     4096, static_cast<std::uint64_t>(seed)));
      five += p <= 0.05 ? 1 : 0;
      one += p <= 0.01 ? 1 : 0;
    }
    EXPECT_LE(five, (0.07 + tests::four_errors(0.07, records)) * records) << row.name;
    EXPECT_LE(one, (0.02 + tests::four_errors(0.02, records)) * records) << row.name;
  }
}

TEST(HosCubicTest, ASineAloneIsNotCoupled) {
  const int records = tests::records_or(200);
  int fires = 0;
  for (int seed = 1; seed <= records; ++seed) {
    fires += p_of(tests::sinusoid_in_noise(static_cast<std::uint64_t>(seed), 50.0)) <= 0.05 ? 1 : 0;
  }
  EXPECT_LE(fires, (0.07 + tests::four_errors(0.07, records)) * records);
}

TEST(HosCubicTest, HasNothingToSayWithoutSegments) {
  EXPECT_FALSE(cubic_statistics({}).has_value());
  EXPECT_FALSE(cubic_statistics(tests::white_noise(1, 71)).has_value());
  EXPECT_FALSE(cubic_statistics(tests::white_noise(1, 130), 40.0).has_value());
  EXPECT_TRUE(cubic_statistics(tests::white_noise(1, 140), 40.0).has_value());
  EXPECT_FALSE(cubic_statistics(std::vector<double>(4096, std::nan(""))).has_value());
}

}  // namespace
}  // namespace loopscope::core::hos
