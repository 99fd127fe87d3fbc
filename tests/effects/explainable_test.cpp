#include "tests/effects/explainable.hpp"

#include <gtest/gtest.h>
#include <string>

#include "tests/effects/draft.hpp"

namespace loopscope::tests::effects {
namespace {

double explainable_of(const Finished& finished) {
  return explainable({finished.draft.base, finished.draft.scenario, finished.series});
}

class Linear : public testing::TestWithParam<const char*> {};

TEST_P(Linear, LeavesNothingToExplain) {
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    EXPECT_NEAR(explainable_of(finish(GetParam(), seed)), 0.0, 0.02) << seed;
}

INSTANTIATE_TEST_SUITE_P(Kinds, Linear,
                         testing::Values("healthy_still", "healthy_moving", "tight_moving",
                                         "sluggish", "sensor_quantisation"),
                         [](const auto& kind) { return std::string(kind.param); });

/// A firm loop in a quiet plant whose set point moves.
Draft quiet_loop(std::uint64_t seed) {
  Random random(seed);
  LoopOptions options{.tuning = Tuning::firm, .moves = Moves::small, .may_integrate = false};
  options.noise = {0.2, 0.2};
  return draw_loop(options, random);
}

double with_valve(const Draft& draft, const std::function<std::unique_ptr<Valve>()>& valve) {
  Scenario scenario = draft.base;
  scenario.valve = valve;
  return explainable({draft.base, scenario, simulate(scenario)});
}

TEST(Explainable, GrowsWithTheEffect) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Draft draft = quiet_loop(seed);
    const auto of_width = [&](double width) {
      return with_valve(draft, [=, op0 = draft.base.op0] {
        return make_backlash_valve(width, {0.1, op0}, 0.1);
      });
    };
    EXPECT_LT(of_width(0.01), 0.02) << seed;
    EXPECT_LT(of_width(0.5) + 0.01, of_width(2.0)) << seed;
    EXPECT_LT(of_width(2.0) + 0.01, of_width(6.0)) << seed;
  }
}

TEST(Explainable, AnotherGainIsNoEffect) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Draft draft = quiet_loop(seed);
    Scenario scenario = draft.base;
    scenario.process_gain = [](double) { return 1.25; };
    EXPECT_NEAR(explainable({draft.base, scenario, simulate(scenario)}), 0.0, 0.02) << seed;
  }
}

TEST(RealisedFloor, IsTheSameWithAndWithoutAnEffect) {
  const Draft draft = quiet_loop(1);
  Scenario scenario = draft.base;
  scenario.process_gain = [](double time) { return time < 2000.0 ? 1.0 : 1.5; };
  EXPECT_NEAR(realised_floor(scenario, simulate(scenario)),
              realised_floor(draft.base, simulate(draft.base)), 1e-9);
}

}  // namespace
}  // namespace loopscope::tests::effects
