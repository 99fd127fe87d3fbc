#include "core/model/controller/octave_power.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include "core/simulate/random.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

TEST(OctavePower, WhiteNoiseHalvesFromOctaveToOctave) {
  const auto octaves = octave_powers(tests::white_noise(65536, 1));
  EXPECT_NEAR(octaves.front().power, 1.0, 0.03);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(octaves[i].share, std::exp2(-1.0 - static_cast<double>(i)), 0.05);
}

TEST(OctavePower, SinusoidStandsInItsOctave) {
  std::vector<double> wave(4096);
  for (std::size_t k = 0; k < wave.size(); ++k) {
    wave[k] = std::sin(2.0 * std::numbers::pi * static_cast<double>(k) / 48.0);
  }
  const auto octaves = octave_powers(wave);
  const auto largest = std::ranges::max_element(octaves, {}, &OctavePower::share);
  EXPECT_LE(largest->low, 2.0 * std::numbers::pi / 48.0);
  EXPECT_GE(largest->high, 2.0 * std::numbers::pi / 48.0);
}

TEST(OctavePower, GapsAreLeftOut) {
  std::vector<double> noise = tests::white_noise(4096, 1);
  for (std::size_t k = 1000; k < 1500; ++k) noise[k] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(octave_powers(noise).front().power, 1.0, 0.1);
}

TEST(OctavePower, ConstantHasNone) {
  EXPECT_TRUE(octave_powers(std::vector<double>(100, 3.0)).empty());
  EXPECT_TRUE(octave_powers({}).empty());
}

}  // namespace
}  // namespace loopscope::core::model
