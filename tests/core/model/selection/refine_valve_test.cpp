#include "core/model/selection/refine_valve.hpp"

#include <gtest/gtest.h>
#include <memory>

#include "core/model/effects/valve.hpp"
#include "core/model/fit/baseline.hpp"
#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kWindow;

/// A valve that sticks, S 4 and J 2.5 % of op, behind which play was found.
CandidateFit play_for_sticking(std::uint64_t seed) {
  const tests::Series op =
      tests::sum(tests::stepping_op(kWindow, seed, 3.0),
                 tests::coloured_noise({1, {0.95, 0, 0}, {}}, kWindow, seed + 100, 0.5));
  tests::Series mv(kWindow);
  run_valve({ValveLaw::he, 4.0, 2.5, 1.0, {0.2, 0.0, 0.0}}, op, mv);
  const tests::Series pv = tests::process_record(tests::one_lag(0.8, 3), 1.5, mv,
                                                 tests::white_noise(kWindow, seed + 200, 0.3));
  const LoopData data = make_loop_data(pv, op, 1.0);
  Fit linear = search_process(data, {});
  Structure play = linear.structure;
  play.effects = {std::make_shared<ValveEffect>(Valve{ValveLaw::he, 4.4, 0.0, 1.0})};
  return scored({{}, {}, data, cross_fit(data, std::move(linear)), 0.0}, search_process(data, play),
                10);
}

TEST(CloserLook, FindsWhatSticksBehindPlay) {
  const CandidateFit entered = play_for_sticking(1);
  ASSERT_EQ(entered.kind(), EffectKind::valve_deadband);
  const std::optional<CandidateFit> closer = refine_valve(entered, entered.fit.fit, 1);
  ASSERT_TRUE(closer);
  EXPECT_EQ(closer->kind(), EffectKind::valve_stiction);
  EXPECT_GT(closer->worth(), entered.worth());
  EXPECT_GT(closer->price, entered.price) << "it was chosen from more guesses";
}

TEST(CloserLook, FindsNothingWhereTheSearchIsLeftOut) {
  CandidateFit entered = play_for_sticking(1);
  entered.rows.without.leave_out(Mechanism::stem_search);
  EXPECT_FALSE(refine_valve(entered, entered.fit.fit, 1));
}

}  // namespace
}  // namespace loopscope::core::model
