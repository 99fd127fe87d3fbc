#include "core/signal/archive.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

#include "core/signal/gaps.hpp"
#include "core/signal/holes.hpp"
#include "tests/core/signal/archives.hpp"

namespace loopscope::core::signal {
namespace {

/// Noise with a pole at 0.8, mean 50, standard deviation 1.
Samples wandering(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Samples samples;
  double value = 0.0;
  for (int k = 0; k < 4096; ++k) {
    value = 0.8 * value + 0.6 * normal(random);
    samples.push_back(50.0 + value);
  }
  return samples;
}

Samples rounded(Samples samples, double step) {
  for (double& value : samples) value = step * std::round(value / step);
  return samples;
}

Kept at_random(double share, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  Kept kept{0};
  for (std::size_t k = 1; k < 4096; ++k) {
    if (uniform(random) < share) kept.push_back(k);
  }
  return kept;
}

/// What is found of samples that were kept like this, in whatever form they arrive.
void expect_found(const Samples& samples, const Kept& kept, Archive archive) {
  for (const Samples& arrived :
       {only(samples, kept), held_between(samples, kept), lines_between(samples, kept)}) {
    const StoredSamples found = find_stored(arrived);
    EXPECT_EQ(found.archive, archive);
    // The last of all is not told from its neighbour where values are held or drawn behind it.
    EXPECT_NEAR(static_cast<double>(count_recorded(found.value)), static_cast<double>(kept.size()),
                2.0);
  }
}

TEST(Archive, AWholeRecordIsComplete) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    for (const double step : {0.0, 0.01, 0.1, 0.5, 1.0}) {
      const Samples samples = step > 0.0 ? rounded(wandering(seed), step) : wandering(seed);
      const StoredSamples found = find_stored(samples);
      EXPECT_EQ(found.archive, step < kCoarseGrid ? Archive::complete : Archive::rounded) << step;
      EXPECT_NEAR(found.band, step < kCoarseGrid ? 0.0 : 0.5 * step, 1e-9);
      EXPECT_EQ(found.value, samples);
    }
  }
}

TEST(Archive, AGapMakesNoArchive) {
  Samples samples = wandering(1);
  for (std::size_t k = 1000; k < 2000; ++k) samples[k] = kMissing;
  EXPECT_EQ(find_stored(samples).archive, Archive::complete);
}

TEST(Archive, ADeadBandIsKnownByTheMovesThatItLacks) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Samples samples = wandering(seed);
    for (const double factor : {1.2, 1.5, 2.5}) {
      expect_found(samples, keep_one_in(factor, samples, keep_dead_band), Archive::dead_band);
    }
  }
}

TEST(Archive, ASwingingDoorIsKnownByTheBendsThatItLacks) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Samples samples = wandering(seed);
    for (const double factor : {1.2, 1.5, 2.5}) {
      expect_found(samples, keep_one_in(factor, samples, keep_swinging_door),
                   Archive::swinging_door);
      expect_found(samples, keep_one_in(factor, samples, keep_opening_doors),
                   Archive::swinging_door);
    }
  }
}

TEST(Archive, SamplesMissingAtRandomAreScattered) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const double share : {0.9, 0.7, 0.4}) {
      expect_found(wandering(seed), at_random(share, seed), Archive::scattered);
    }
  }
}

TEST(Archive, TheBandIsTheArchives) {
  const Samples samples = wandering(3);
  EXPECT_NEAR(find_stored(only(samples, keep_dead_band(samples, 0.7))).band, 0.7, 0.03);
  EXPECT_NEAR(find_stored(only(samples, keep_swinging_door(samples, 0.4))).band, 0.4, 0.03);
}

TEST(Archive, RoundedValuesAreRecognisedToo) {
  const Samples samples = wandering(3);
  const Kept band = keep_one_in(2.0, samples, keep_dead_band);
  const Kept door = keep_one_in(2.0, samples, keep_swinging_door);
  EXPECT_EQ(find_stored(rounded(held_between(samples, band), 0.01)).archive, Archive::dead_band);
  EXPECT_EQ(find_stored(rounded(lines_between(samples, door), 0.001)).archive,
            Archive::swinging_door);
}

TEST(Archive, ACoarseValueStoredOnChangeStaysAsItWas) {
  const Samples samples = rounded(wandering(3), 1.0);
  Kept changes{0};
  for (std::size_t k = 1; k < samples.size(); ++k) {
    if (samples[k] != samples[k - 1]) changes.push_back(k);
  }
  const StoredSamples found = find_stored(only(samples, changes));
  EXPECT_EQ(found.archive, Archive::on_change);
  EXPECT_EQ(reconstruct(found).value, samples);
}

TEST(Archive, ASlowSensorIsNoArchive) {
  Samples samples = wandering(3);
  for (std::size_t k = 0; k < samples.size(); ++k) samples[k] = samples[k - k % 12];
  EXPECT_EQ(find_stored(samples).archive, Archive::coarser);
  EXPECT_EQ(find_stored(samples).value, samples);
}

TEST(Archive, AFrozenStretchIsMaskedFromItsSecondSampleOn) {
  Samples samples = wandering(3);
  for (std::size_t k = 1000; k < 1200; ++k) samples[k] = samples[999];
  const StoredSamples found = find_stored(samples);
  EXPECT_EQ(found.archive, Archive::complete);
  EXPECT_EQ(count_recorded(found.value), samples.size() - 200);
}

/// Saturation is what a loop has, not what an archive does.
TEST(Archive, ClippedValuesAreValues) {
  Samples samples = wandering(3);
  for (double& value : samples) value = std::min(value, 51.0);
  EXPECT_EQ(find_stored(samples).archive, Archive::complete);
  EXPECT_EQ(find_stored(samples).value, samples);
}

}  // namespace
}  // namespace loopscope::core::signal
