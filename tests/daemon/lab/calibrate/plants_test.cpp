#include "daemon/lab/calibrate/plants.hpp"

#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "core/simulate/innovations.hpp"

namespace loopscope::daemon {
namespace {

/// Plants of uniform p-values for healthy loops and `p_faulty` for faulty ones.
std::vector<PlantPool> synthetic(const PlantSettings& settings, double p_faulty) {
  std::vector<PlantPool> pools(settings.plants);
  for (std::size_t plant = 0; plant < settings.plants; ++plant) {
    pools[plant].healthy = core::simulate::innovations(core::simulate::Innovation::uniform,
                                                       settings.loops, 100 + plant);
    for (double& p : pools[plant].healthy) p = 0.5 + p / std::sqrt(12.0);
    pools[plant].faulty.assign(settings.loops / 50, p_faulty);
  }
  return pools;
}

TEST(Plants, UniformHealthyLoopsKeepTheRate) {
  PlantSettings settings;
  settings.plants = 40;
  const auto summaries = judge_plants(settings, synthetic(settings, 1e-9));
  ASSERT_EQ(summaries.size(), 2U);
  for (const PlantSummary& summary : summaries) {
    EXPECT_EQ(summary.found_share.mean, 1.0);
    // Benjamini and Hochberg expect exactly rate times the share of healthy loops.
    const double expected = settings.rate * (1.0 - summary.fault_share);
    EXPECT_NEAR(summary.false_share.mean, expected, 4.0 * summary.false_share.standard_error);
    EXPECT_GT(summary.false_share.standard_error, 0.0);
  }
  EXPECT_EQ(summaries[0].faulty, 200U);
  EXPECT_EQ(summaries[1].faulty, 10U);
}

TEST(Plants, FaultsThatDoNotShowAreNotFound) {
  PlantSettings settings;
  settings.plants = 5;
  const auto summaries = judge_plants(settings, synthetic(settings, 0.5));
  EXPECT_EQ(summaries[0].found_share.mean, 0.0);
}

TEST(Plants, FamiliesAddUp) {
  PlantSettings settings;
  settings.plants = 3;
  for (const PlantSummary& summary : judge_plants(settings, synthetic(settings, 1e-9))) {
    std::size_t loops = 0;
    std::size_t flagged = 0;
    for (const auto& [name, family] : summary.families) {
      loops += family.loops;
      flagged += family.flagged;
    }
    EXPECT_EQ(loops, 3U * settings.loops);
    EXPECT_NEAR(static_cast<double>(flagged), 3.0 * summary.flags.mean, 1e-6);
    EXPECT_EQ(summary.untested, 0U);
  }
}

TEST(Plants, LoopsWithoutAPAreNotTested) {
  PlantSettings settings;
  settings.plants = 1;
  const auto pools = synthetic(settings, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(judge_plants(settings, pools)[0].untested, 200U);
}

TEST(Plants, AreDrawnAlikeInAnyNumberOfThreads) {
  PlantSettings settings;
  settings.plants = 2;
  settings.loops = 100;
  std::atomic<std::size_t> done = 0;
  const auto draw = [&](std::size_t threads) {
    // Any figure of the record tells whether it is the same record.
    const auto first_finite = [] {
      return [](std::span<const double> signal) {
        for (const double sample : signal) {
          if (std::isfinite(sample)) return sample;
        }
        return 0.0;
      };
    };
    return draw_plants(settings, threads, first_finite, [&done] { ++done; });
  };
  const auto one = draw(1);
  const auto three = draw(3);
  EXPECT_EQ(done, 2 * drawn_loops(settings));
  ASSERT_EQ(one.size(), 2U);
  EXPECT_NE(one[0].healthy, one[1].healthy);
  for (std::size_t plant = 0; plant < 2; ++plant) {
    EXPECT_EQ(one[plant].healthy, three[plant].healthy);
    EXPECT_EQ(one[plant].faulty, three[plant].faulty);
    EXPECT_EQ(one[plant].healthy.size(), 100U);
    EXPECT_EQ(one[plant].faulty.size(), 2U);
  }
}

}  // namespace
}  // namespace loopscope::daemon
