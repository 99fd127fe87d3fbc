#include "core/model/valve_search/hysteresis_grid_search.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "core/model/effects/valve.hpp"
#include "core/model/fit/baseline.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

struct Loop {
  LoopData data;
  Fit linear;
};

Loop loop_of(const char* scenario, std::uint64_t seed) {
  const auto record = simulate::simulate_scenario(scenario, {}, seed);
  Loop loop{make_loop_data(record.pv, record.op, record.sample_interval_s), {}};
  loop.linear = search_process(loop.data, {});
  return loop;
}

/// n ln of the errors on the fit rows.
double gain_of(const Loop& loop, const GridResult& find) {
  return static_cast<double>(loop.data.rows.fit_count()) *
         std::log(loop.linear.fit_error / find.fit_error);
}

TEST(HysteresisNet, FindsThePlayOfAWornLinkage) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Loop loop = loop_of("deadband", seed);
    const auto play = find_play(loop.data, loop.linear);
    ASSERT_TRUE(play);
    EXPECT_GT(gain_of(loop, *play), 30.0) << seed;
    EXPECT_EQ(tests::valve_of(*play).slip_jump_percent, 0.0);
  }
}

/// What a healthy loop gains by the best of all bands is what one parameter gains by chance.
TEST(HysteresisNet, AHealthyLoopGainsNothing) {
  int gained = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Loop loop = loop_of("healthy_flow", seed);
    const auto play = find_play(loop.data, loop.linear);
    gained += play && gain_of(loop, *play) > 10.0 ? 1 : 0;
  }
  EXPECT_LE(gained, 2);
}

TEST(HysteresisNet, ASlippingValveGainsMoreThanPlay) {
  const Loop loop = loop_of("sticking_valve", 2);
  const auto play = find_play(loop.data, loop.linear);
  ASSERT_TRUE(play);
  const std::vector<GridResult> found = find_sticking(loop.data, loop.linear, *play);
  ASSERT_FALSE(found.empty());
  const auto best = std::ranges::min_element(found, {}, &GridResult::fit_error);
  EXPECT_LT(best->fit_error, play->fit_error);
  EXPECT_GT(tests::valve_of(*best).slip_jump_percent, 0.0);
}

TEST(HysteresisNet, AnOutputThatStandsHasNoPlay) {
  Loop loop = loop_of("healthy_flow", 1);
  std::ranges::fill(loop.data.op, 0.0);
  EXPECT_FALSE(find_play(loop.data, loop.linear));
}

TEST(HysteresisNet, APlayThatBeatsWhatItHasToIsFoundAllTheSame) {
  const Loop loop = loop_of("deadband", 1);
  const auto play = find_play(loop.data, loop.linear);
  const auto bounded = find_play(loop.data, loop.linear, 0.99 * loop.linear.fit_error);
  ASSERT_TRUE(play && bounded);
  EXPECT_EQ(tests::valve_of(*bounded).stickband_percent, tests::valve_of(*play).stickband_percent);
  EXPECT_EQ(bounded->fit_error, play->fit_error);
}

TEST(HysteresisNet, APlayWithoutHopeIsGivenUpAsItStands) {
  const Loop loop = loop_of("healthy_flow", 1);
  const auto play = find_play(loop.data, loop.linear);
  const auto bounded = find_play(loop.data, loop.linear, 0.5 * loop.linear.fit_error);
  ASSERT_TRUE(play && bounded);
  EXPECT_GE(bounded->fit_error, play->fit_error);
}

}  // namespace
}  // namespace loopscope::core::model
