#include "core/signal/spikes.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/signal/order/spread.hpp"
#include "core/simulate/innovations.hpp"
#include "core/simulate/limit_cycle.hpp"

namespace loopscope::core::signal {
namespace {

Samples noise(std::uint64_t seed, double pole = 0.0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Samples samples(4096);
  double state = 0.0;
  for (double& v : samples) v = state = pole * state + normal(random);
  return samples;
}

/// Makes the outliers of a signal without a loop missing; how many samples they were.
std::size_t discard_spikes(Samples& samples) {
  const std::vector<bool> found = find_spikes(samples, {}, {});
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (found[k]) samples[k] = kMissing;
  }
  return static_cast<std::size_t>(std::count(found.begin(), found.end(), true));
}

TEST(Spikes, AnIsolatedOutlierBecomesMissing) {
  Samples samples = noise(1);
  samples[1000] = 15.0;
  samples[2000] = -15.0;
  EXPECT_EQ(discard_spikes(samples), 2U);
  EXPECT_TRUE(std::isnan(samples[1000]) && std::isnan(samples[2000]));
}

/// Share of what was planted that is taken out of 100 records, and samples taken out beside it.
struct Found {
  double share = 0.0;
  double beside = 0.0;
};

Found find_planted(double pole, double size, std::size_t length) {
  constexpr int kRecords = 100;
  constexpr std::size_t kSpikes = 20;
  std::size_t hit = 0;
  std::size_t all = 0;
  for (std::uint64_t seed = 1; seed <= kRecords; ++seed) {
    Samples samples = noise(seed, pole);
    const double std = measure_spread(samples)->std;
    for (std::size_t i = 0; i < kSpikes * length; ++i) {
      samples[100 + 200 * (i / length) + i % length] += (i / length % 2 == 0 ? size : -size) * std;
    }
    all += discard_spikes(samples);
    for (std::size_t i = 0; i < kSpikes * length; ++i) {
      hit += std::isnan(samples[100 + 200 * (i / length) + i % length]) ? 1U : 0U;
    }
  }
  return {static_cast<double>(hit) / static_cast<double>(kRecords * kSpikes * length),
          static_cast<double>(all - hit) / kRecords};
}

TEST(Spikes, OfEightStandardDeviationsAreFoundInAnyNoise) {
  for (const double pole : {0.0, 0.5, 0.9}) {
    for (const std::size_t length : {1U, 2U}) {
      const Found found = find_planted(pole, 8.0, length);
      EXPECT_GT(found.share, 0.97) << pole << ' ' << length;
      EXPECT_LT(found.beside, 2.0) << pole << ' ' << length;
    }
    EXPECT_GT(find_planted(pole, 6.0, 1).share, 0.9) << pole;
  }
}

TEST(Spikes, LongTailsAreLeftAlone) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Samples samples = simulate::innovations(simulate::Innovation::laplace, 4096, seed);
    found += discard_spikes(samples);
  }
  // One record in twenty loses its largest sample.
  EXPECT_LE(found, 12U);
}

TEST(Spikes, ALouderStretchIsLeftAlone) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Samples samples = noise(seed);
    for (std::size_t k = 2000; k < 2200; ++k) samples[k] *= 3.0;
    found += discard_spikes(samples);
  }
  EXPECT_LE(found, 100U);
}

TEST(Spikes, CyclesOfEveryShapeAreLeftAlone) {
  for (const auto shape : {simulate::WaveShape::square, simulate::WaveShape::triangle,
                           simulate::WaveShape::sawtooth, simulate::WaveShape::asymmetric_square}) {
    for (const double period : {16.0, 64.0, 400.0}) {
      for (const double snr_db : {0.0, 10.0, 30.0}) {
        Samples samples = simulate::limit_cycle(
            {.shape = shape, .period_samples = period, .snr_db = snr_db}, 4096, 1);
        EXPECT_EQ(discard_spikes(samples), 0U) << name(shape) << ' ' << period << ' ' << snr_db;
      }
    }
  }
}

TEST(Spikes, GaussianNoiseIsLeftAlone) {
  for (const double pole : {0.0, 0.9, 0.99, 1.0}) {
    std::size_t found = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      Samples samples = noise(seed, pole);
      found += discard_spikes(samples);
    }
    EXPECT_LE(found, 1U) << pole;
  }
}

TEST(Spikes, StepsAndLimitCyclesAreLeftAlone) {
  Samples step = noise(2);
  for (std::size_t k = 2000; k < step.size(); ++k) step[k] += 50.0;
  EXPECT_EQ(discard_spikes(step), 0U);
  Samples square = noise(3);
  for (std::size_t k = 0; k < square.size(); ++k) square[k] += k / 25 % 2 == 0 ? 30.0 : -30.0;
  EXPECT_EQ(discard_spikes(square), 0U);
  Samples held(4096);
  for (std::size_t k = 0; k < held.size(); ++k) held[k] = static_cast<double>(k / 12 % 7);
  EXPECT_EQ(discard_spikes(held), 0U);
}

TEST(Spikes, ASignalFullOfOutliersIsHowItIs) {
  Samples samples = noise(4);
  for (std::size_t k = 0; k < samples.size(); k += 50) samples[k] = 100.0;
  EXPECT_EQ(discard_spikes(samples), 0U);
}

TEST(Spikes, ConstantEmptyAndBrokenSignals) {
  Samples constant(100, 5.0);
  EXPECT_EQ(discard_spikes(constant), 0U);
  Samples empty;
  EXPECT_EQ(discard_spikes(empty), 0U);
  Samples missing(100, kMissing);
  EXPECT_EQ(discard_spikes(missing), 0U);
}

}  // namespace
}  // namespace loopscope::core::signal
