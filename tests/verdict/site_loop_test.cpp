#include "tests/verdict/site_loop.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace loopscope::tests::verdict {
namespace {

using Code = core::diagnosis::VerdictCode;

TEST(SiteLoop, MostAreHealthyAndTheOthersHaveOneFault) {
  constexpr int kLoops = 400;
  int healthy = 0;
  std::set<Code> causes;
  for (std::uint64_t seed = 0; seed < std::uint64_t{kLoops}; ++seed) {
    const Truth truth = site_loop(seed).truth;
    EXPECT_LE(truth.causes.size(), 1U) << "seed " << seed;
    causes.insert(truth.causes.begin(), truth.causes.end());
    healthy += truth.causes.empty() ? 1 : 0;
  }
  // Seven in ten by lot; five standard deviations are 46.
  EXPECT_GT(healthy, 240);
  EXPECT_LT(healthy, 340);
  EXPECT_EQ(causes,
            (std::set{Code::valve_stiction, Code::valve_deadband, Code::valve_saturation,
                      Code::external_disturbance, Code::tight_tuning, Code::sluggish_tuning}));
}

TEST(SiteLoop, SoundLoopsStayWithinTheirRanges) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const SimulatedLoop loop = site_loop(seed);
    if (!loop.truth.causes.empty() || !loop.truth.doubtful.empty()) continue;
    const auto pv = std::ranges::minmax(loop.pv), op = std::ranges::minmax(loop.op);
    EXPECT_LT(pv.max - pv.min, 100.0) << "seed " << seed;
    EXPECT_GT(op.min, 0.0) << "seed " << seed;
    EXPECT_LT(op.max, 100.0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace loopscope::tests::verdict
