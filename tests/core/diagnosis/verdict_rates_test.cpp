#include <cstdint>
#include <gtest/gtest.h>

#include "tests/core/diagnosis/uncoupled_verdicts.hpp"

/// How often loops of core/simulate are flagged by the branch without coupling; the tables of the
/// READMEs are `tables verdict_uncoupled_branch` and `tables verdict_plants`.
namespace loopscope::core::diagnosis {
namespace {

using tests::kFaulty;
using tests::kHealthy;
using tests::p_in_family;
using tests::shown;
using tests::uncoupled;

/// In a plant of 10 000 loops with ten faulty ones p has to be below about 1e-5.
TEST(VerdictRates, HealthyLoopsDoNotReachThePlantsThresholdAndFaultyOnesDo) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    for (const char* scenario : kHealthy) EXPECT_GT(p_in_family(uncoupled(scenario, seed)), 1e-4);
  }
  for (const char* scenario : kFaulty) {
    int certain = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      certain += p_in_family(uncoupled(scenario, seed)) <= 1e-5 ? 1 : 0;
    }
    EXPECT_GE(certain, 18) << scenario;
  }
}

/// A good loop under a load that drifts is as far from the best: only a controller that is known
/// tells the two apart.
TEST(VerdictRates, SlownessIsNotShownWithoutTheController) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_FALSE(shown(uncoupled("sluggish_tuning", seed)));
}

}  // namespace
}  // namespace loopscope::core::diagnosis
