#include "core/model/effects/valve.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "core/model/fit/trial.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/core/model/effects/neighbours.hpp"

namespace loopscope::core::model {
namespace {

ValveEffect kano(double band, double jump) {
  return ValveEffect({ValveLaw::kano, band, jump, 1.0});
}

simulate::LoopRecord sticking(simulate::StictionLaw law) {
  return tests::noiseless_loop(
      simulate::ValveStiction{.stickband_percent = 4.0, .slip_jump_percent = 2.0, .law = law}, 8.0);
}

double greatest_distance(const tests::Series& flow, const simulate::LoopRecord& record) {
  double greatest = 0.0;
  // The start of the record is unknown to the law; a few setpoint moves put that right.
  for (std::size_t k = 400; k < flow.size(); ++k) {
    greatest = std::max(greatest, std::abs(flow[k] - record.mv[k]));
  }
  return greatest;
}

TEST(ValveEffect, FlowIsThePositionOfTheSimulatedValves) {
  for (const auto& [law, simulated] :
       {std::pair{ValveLaw::kano, simulate::StictionLaw::kano},
        std::pair{ValveLaw::choudhury, simulate::StictionLaw::choudhury}}) {
    const simulate::LoopRecord record = sticking(simulated);
    tests::Series flow = record.op;
    ValveEffect({law, 4.0, 2.0, 1.0}).shape_flow(flow);
    EXPECT_LT(greatest_distance(flow, record), 1e-9) << name(law);
  }
}

TEST(ValveEffect, WithoutAJumpItIsPlay) {
  const simulate::LoopRecord record =
      tests::noiseless_loop(simulate::ValveDeadband{.width_percent = 4.0}, 8.0);
  tests::Series flow = record.op;
  kano(4.0, 0.0).shape_flow(flow);
  EXPECT_LT(greatest_distance(flow, record), 1e-9);
}

TEST(ValveEffect, DistancesFromTheMeanGiveTheSameFlow) {
  const simulate::LoopRecord record = sticking(simulate::StictionLaw::kano);
  tests::Series flow = record.op;
  tests::Series shifted = tests::sum(record.op, tests::Series(record.op.size(), -50.0));
  kano(4.0, 2.0).shape_flow(flow);
  kano(4.0, 2.0).shape_flow(shifted);
  for (std::size_t k = 0; k < flow.size(); ++k) EXPECT_NEAR(shifted[k], flow[k] - 50.0, 1e-9);
}

TEST(ValveEffect, WithoutABandItIsTheIdentity) {
  const tests::Series op = tests::stepping_op(500, 1);
  tests::Series flow = op;
  kano(0.0, 0.0).shape_flow(flow);
  EXPECT_EQ(flow, op);
}

TEST(ValveEffect, SmallJumpsArePlayAndTheirWordsToo) {
  const LoopData data;
  const ValveEffect sticks = kano(4.0, 2.0), plays = kano(4.0, 0.4);
  EXPECT_EQ(sticks.kind(), EffectKind::valve_stiction);
  EXPECT_EQ(plays.kind(), EffectKind::valve_deadband);
  EXPECT_EQ(sticks.law(), "kano");
  EXPECT_TRUE(plays.law().empty());
  EXPECT_EQ(tests::value_of(sticks.parameters(data, {}, 1.0), "S"), 4.0);
  EXPECT_EQ(tests::value_of(sticks.parameters(data, {}, 1.0), "J"), 2.0);
  EXPECT_EQ(tests::value_of(plays.parameters(data, {}, 1.0), "width"), 4.0);
  tests::expect_words(sticks, sticks.parameters(data, {}, 1.0));
  tests::expect_words(plays, plays.parameters(data, {}, 1.0));
}

TEST(ValveEffect, JumpsByAShareOfItsBand) {
  for (const double share : {0.0, 0.5, 1.0}) {
    const EffectPtr effect = kano(4.0, 1.0).with_jump(share);
    const auto& valve = dynamic_cast<const ValveEffect&>(*effect).valve();
    EXPECT_EQ(valve.slip_jump_percent, 4.0 * share);
    EXPECT_EQ(valve.stickband_percent, 4.0);
  }
}

TEST(ValveEffect, NeighboursAreValves) {
  tests::expect_columns(kano(4.0, 2.0));
  EXPECT_EQ(kano(4.0, 2.0).column_count(), 0U);
  for (const ValveEffect& effect : {kano(4.0, 2.0), kano(4.0, 0.0), kano(4.0, 4.0)}) {
    for (const double scale : {1.0, 0.5, 0.1}) {
      for (const EffectPtr& neighbour : effect.neighbours(scale)) {
        const auto& valve = dynamic_cast<const ValveEffect&>(*neighbour).valve();
        EXPECT_GE(valve.slip_jump_percent, 0.0);
        EXPECT_LE(valve.slip_jump_percent, valve.stickband_percent);
        EXPECT_EQ(valve.law, ValveLaw::kano);
      }
    }
  }
  // With J between 0 and S every neighbour is another valve.
  tests::expect_neighbours(kano(4.0, 2.0));
}

/// From 1 % of the band and a quarter of the jump off, in a limit cycle with load and noise. The
/// jump is nearly flat in the error, so nothing is asked of it here; a wrong one may hold the band.
TEST(ValveEffect, RefiningFindsTheBand) {
  int found_it = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const simulate::LoopRecord record = simulate::simulate_scenario("sticking_valve", {}, seed);
    const LoopData data = make_loop_data(record.pv, record.op, 1.0);
    Structure start = tests::structure_of(tests::noiseless_process(),
                                          {std::make_shared<ValveEffect>(kano(5.05, 1.5))});
    start.noise = {1, {0.98, 0.0, 0.0}, {-0.6, 0.0, 0.0}};
    const Fit before = evaluate(data, start);
    const Fit fit = refine_last(data, before);
    EXPECT_LT(fit.fit_error, 0.8 * before.fit_error) << seed;
    const auto& found = dynamic_cast<const ValveEffect&>(*fit.structure.effects.back());
    found_it += std::abs(found.valve().stickband_percent - 5.0) <= 0.05;
  }
  EXPECT_GE(found_it, 7);
}

}  // namespace
}  // namespace loopscope::core::model
