#include "core/simulate/missing_samples.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace loopscope::core::simulate {
namespace {

std::size_t missing(const std::vector<double>& signal) {
  return static_cast<std::size_t>(
      std::ranges::count_if(signal, [](double x) { return std::isnan(x); }));
}

std::size_t gaps(const std::vector<double>& signal) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < signal.size(); ++k) {
    count += std::isnan(signal[k]) && (k == 0 || !std::isnan(signal[k - 1])) ? 1U : 0U;
  }
  return count;
}

TEST(MissingSamples, GapsTakeTheShareAskedFor) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto signal = with_gaps(std::vector<double>(4096, 1.0), 0.4, 10, seed);
    EXPECT_EQ(missing(signal), 1630U);  // 10 blocks of floor(0.4 * 409)
    EXPECT_GE(gaps(signal), 1U);
    EXPECT_LE(gaps(signal), 10U);
  }
}

TEST(MissingSamples, EveryPlaceCanBeMissing) {
  std::vector<int> hits(50);
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const auto signal = with_gaps(std::vector<double>(50, 1.0), 0.4, 2, seed);
    for (std::size_t k = 0; k < 50; ++k) hits[k] += std::isnan(signal[k]) ? 1 : 0;
  }
  EXPECT_GT(*std::ranges::min_element(hits), 0);
}

TEST(MissingSamples, SpikesAreSingleSamples) {
  const auto signal = with_masked_spikes(std::vector<double>(4096, 1.0), 20, 1);
  EXPECT_GE(missing(signal), 18U);  // a place may be drawn twice
  EXPECT_LE(missing(signal), 20U);
}

TEST(MissingSamples, NothingAskedNothingMissing) {
  EXPECT_EQ(missing(with_gaps(std::vector<double>(100, 1.0), 0.0, 3, 1)), 0U);
  EXPECT_EQ(missing(with_masked_spikes(std::vector<double>(100, 1.0), 0, 1)), 0U);
}

}  // namespace
}  // namespace loopscope::core::simulate
