#include "core/hos/linear/stationary_stretch.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "core/simulate/calibration_families.hpp"
#include "core/simulate/coloured_noise.hpp"
#include "tests/core/hos/signals.hpp"

namespace loopscope::core::hos {
namespace {

using tests::kRecord;

std::vector<double> coloured(const simulate::AllPole& filter, std::uint64_t seed) {
  return simulate::coloured_noise(filter, simulate::Innovation::gaussian, kRecord, seed);
}

/// One process up to sample `at`, another one from there on.
std::vector<double> changed(const simulate::AllPole& before, const simulate::AllPole& after,
                            std::size_t at, std::uint64_t seed) {
  std::vector<double> record = coloured(before, 2 * seed);
  const std::vector<double> other = coloured(after, 2 * seed + 1);
  std::copy(other.begin() + static_cast<std::ptrdiff_t>(at), other.end(),
            record.begin() + static_cast<std::ptrdiff_t>(at));
  return record;
}

TEST(StationaryStretch, EndsWhereTheSpectrumChanges) {
  int right = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto record =
        changed(simulate::resonance(40.0, 0.9), simulate::real_pole(0.5), 1536, seed);
    right += stationary_stretch(record) == Stretch{1664, kRecord - 1664} ? 1 : 0;
  }
  EXPECT_GE(right, 48);
}

TEST(StationaryStretch, SeveralChangesLeaveTheLongestPart) {
  std::vector<double> record = changed(simulate::real_pole(0.9), simulate::real_pole(0.0), 1024, 1);
  const std::vector<double> last = coloured(simulate::resonance(20.0, 0.95), 7);
  std::copy(last.begin() + 3072, last.end(), record.begin() + 3072);
  EXPECT_EQ(stationary_stretch(record), (Stretch{1152, 1792}));
}

/// Share of `records` records of a calibration family that are cut.
double cut_share(const char* name, int records) {
  const auto& families = simulate::calibration_families();
  const auto family = std::ranges::find(families, name, &simulate::CalibrationFamily::name);
  int cut = 0;
  for (int i = 0; i < records; ++i) {
    const auto record = family->draw(family->samples, 40'000 + static_cast<std::uint64_t>(i));
    cut += stationary_stretch(record).size < record.size() ? 1 : 0;
  }
  return static_cast<double>(cut) / records;
}

TEST(StationaryStretch, StationaryRecordsAreLeftWhole) {
  for (const char* const name :
       {"white", "ar1_0.9", "ar1_0.99", "random_walk", "resonance_20_pole_0.99",
        "resonance_200_pole_0.995", "sinusoid_20_at_20_db", "white_gaps", "ar1_0.9_1000",
        "white_laplace", "white_exponential", "ar1_0.9_exponential", "paper_5_1"}) {
    EXPECT_LE(cut_share(name, 100), 0.03) << name;
  }
}

TEST(StationaryStretch, ALouderPartIsNoChange) {
  EXPECT_LE(cut_share("ar1_0.9_half_twice", 100), 0.03);
  EXPECT_LE(cut_share("ar1_0.9_tenth_thrice", 100), 0.03);
}

TEST(StationaryStretch, CyclesAreLeftWhole) {
  for (const char* const name : {"square_64", "triangle_64", "sawtooth_130", "asymmetric_square_30",
                                 "square_400", "paper_5_4_kano", "paper_4_1_nonlinear"}) {
    EXPECT_LE(cut_share(name, 40), 0.1) << name;
  }
}

TEST(StationaryStretch, WhatCannotBeFittedIsWhole) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(stationary_stretch({}), (Stretch{0, 0}));
  EXPECT_EQ(stationary_stretch(std::vector<double>(300, 1.0)), (Stretch{0, 300}));
  EXPECT_EQ(stationary_stretch(std::vector<double>(1000, 5.0)), (Stretch{0, 1000}));
  EXPECT_EQ(stationary_stretch(std::vector<double>(1000, kNan)), (Stretch{0, 1000}));
}

}  // namespace
}  // namespace loopscope::core::hos
