#include "core/model/valve_law/valve_law.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "core/simulate/effects/valve_deadband.hpp"
#include "core/simulate/effects/valve_stiction.hpp"
#include "core/simulate/random.hpp"
#include "tests/core/model/valve_moves.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kNaN;

using tests::positions;
using tests::wandering_op;

/// The simulator's valve after a move that ends at rest at `op` in that direction.
simulate::StickingValve arrived(const Valve& valve, double op) {
  const auto law =
      valve.law == ValveLaw::kano ? simulate::StictionLaw::kano : simulate::StictionLaw::choudhury;
  simulate::StickingValve simulated({valve.stickband_percent, valve.slip_jump_percent, law});
  simulated.next(op - 3.0 * valve.start_direction * valve.stickband_percent);
  for (int k = 0; k < 3; ++k) {
    simulated.next(op);
  }
  return simulated;
}

void expect_simulated(const Valve& valve, const std::vector<double>& op) {
  simulate::StickingValve simulated = arrived(valve, op[0]);
  const std::vector<double> mv = positions(valve, op);
  for (std::size_t k = 0; k < op.size(); ++k) {
    ASSERT_NEAR(mv[k], simulated.next(op[k]), 1e-9) << name(valve.law) << " sample " << k;
  }
}

TEST(ValveLaw, IsTheSimulatedValveSampleBySample) {
  for (const ValveLaw law : {ValveLaw::choudhury, ValveLaw::kano}) {
    for (const double jump : {0.0, 0.7, 2.0, 3.0}) {
      for (const double direction : {1.0, -1.0}) {
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
          expect_simulated({law, 3.0, jump, direction}, wandering_op(seed));
        }
      }
    }
  }
}

TEST(ValveLaw, IsTheSimulatedValveWhereOpStandsStill) {
  for (const ValveLaw law : {ValveLaw::choudhury, ValveLaw::kano}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      expect_simulated({law, 3.1, 1.3, 1.0}, wandering_op(seed, 0.75));
    }
  }
}

TEST(ValveLaw, WithoutJumpIsPlay) {
  for (const ValveLaw law : {ValveLaw::kano, ValveLaw::he}) {
    const std::vector<double> op = wandering_op(3);
    simulate::ValveWithPlay play({2.0});
    play.next(op[0] - 9.0);
    const std::vector<double> mv = positions({law, 2.0, 0.0, 1.0}, op);
    for (std::size_t k = 0; k < op.size(); ++k) {
      ASSERT_NEAR(mv[k], play.next(op[k]), 1e-9) << name(law) << " sample " << k;
    }
  }
}

TEST(ValveLaw, WithoutBandIsOp) {
  const std::vector<double> op = wandering_op(4);
  for (const ValveLaw law : {ValveLaw::choudhury, ValveLaw::kano, ValveLaw::he}) {
    const std::vector<double> mv = positions({law, 0.0, 0.0, 1.0}, op);
    for (std::size_t k = 0; k < op.size(); ++k) {
      ASSERT_DOUBLE_EQ(mv[k], op[k]) << name(law);
    }
  }
}

TEST(ValveLaw, HeSlipsWhenOpIsHalfOfSPlusJAway) {
  // S = 3, J = 1: breaks loose beyond 2, stays 1 behind; starts 1 below op.
  const std::vector<double> op = {10.0, 10.9, 11.1, 11.9, 12.2, 9.0, 8.0};
  const std::vector<double> mv = positions({ValveLaw::he, 3.0, 1.0, 1.0}, op);
  const std::vector<double> expected = {9.0, 9.0, 10.1, 10.1, 11.2, 10.0, 10.0};
  for (std::size_t k = 0; k < op.size(); ++k) {
    EXPECT_NEAR(mv[k], expected[k], 1e-12) << k;
  }
}

TEST(ValveLaw, StandsWhereOpIsMissing) {
  for (const ValveLaw law : {ValveLaw::choudhury, ValveLaw::kano, ValveLaw::he}) {
    const std::vector<double> mv =
        positions({law, 2.0, 1.0, 1.0}, {kNaN, 50.0, 55.0, kNaN, kNaN, 56.0});
    EXPECT_TRUE(std::isnan(mv[0]));
    EXPECT_DOUBLE_EQ(mv[1], 49.5);
    EXPECT_DOUBLE_EQ(mv[2], 54.5);
    EXPECT_DOUBLE_EQ(mv[4], 54.5);
  }
}

TEST(ValveLaw, AValveMayBeginElsewhere) {
  const std::vector<double> op(3, 50.0);
  std::vector<double> mv(3);
  run_valve({ValveLaw::he, 3.0, 1.0, 1.0, {}, 50.8}, op, mv);
  EXPECT_EQ(mv, (std::vector<double>{50.8, 50.8, 50.8}));
}

/// Bands and jumps of all kinds; each half comes from one direction.
std::vector<Valve> some_valves(ValveLaw law, std::size_t count) {
  std::vector<Valve> valves;
  for (std::size_t i = 0; i < count; ++i) {
    const double band = 1.0 + 2.0 * static_cast<double>(i);
    valves.push_back({law, band, 0.3 * static_cast<double>(i % 4) * band, i < 4 ? -1.0 : 1.0});
  }
  valves.back().start_percent = 48.0;
  return valves;
}

TEST(ValveLaw, SideBySideTheyStandWhereEachDoesByItself) {
  std::vector<double> op = wandering_op(3, 0.5);
  op[0] = op[1] = op[40] = op[41] = kNaN;
  for (const ValveLaw law : {ValveLaw::choudhury, ValveLaw::kano, ValveLaw::he}) {
    for (std::size_t count = 1; count <= kSideBySide; ++count) {
      const std::vector<Valve> valves = some_valves(law, count);
      std::vector<EightNumbers> together(op.size());
      run_valves(valves, op, together);
      for (std::size_t i = 0; i < count; ++i) {
        const std::vector<double> alone = positions(valves[i], op);
        for (std::size_t k = 2; k < op.size(); ++k) ASSERT_EQ(together[k][i], alone[k]) << k;
        EXPECT_TRUE(std::isnan(together[1][i]));
      }
    }
  }
}

TEST(ValveLaw, RefusesAJumpOutsideTheBand) {
  std::vector<double> values(3, 1.0);
  EXPECT_THROW(run_valve(ValveLaw::kano, 1.0, 2.0, 1.0, values, values), std::invalid_argument);
  EXPECT_THROW(run_valve(ValveLaw::he, 1.0, -0.1, 1.0, values, values), std::invalid_argument);
  std::vector<EightNumbers> eight(3);
  EXPECT_THROW(run_valves(std::array{Valve{ValveLaw::he, 1.0, 2.0}}, values, eight),
               std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::model
