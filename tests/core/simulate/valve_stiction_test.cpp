#include "core/simulate/effects/valve_stiction.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/simulate/random.hpp"

namespace loopscope::core::simulate {
namespace {

std::vector<double> positions(const ValveStiction& stiction, const std::vector<double>& op) {
  StickingValve valve(stiction);
  std::vector<double> result;
  for (const double value : op) {
    result.push_back(valve.next(value));
  }
  return result;
}

std::vector<double> random_walk(std::uint64_t seed) {
  GaussianSource noise(seed);
  std::vector<double> op(2000);
  double value = 50.0;
  for (double& sample : op) {
    value += 0.3 * noise.next();
    sample = value;
  }
  return op;
}

class BothLaws : public testing::TestWithParam<StictionLaw> {};
INSTANTIATE_TEST_SUITE_P(ValveStiction, BothLaws,
                         testing::Values(StictionLaw::choudhury, StictionLaw::kano),
                         [](const auto& law) { return std::string(name(law.param)); });

TEST_P(BothLaws, WithoutBandAndJumpIsTheIdentity) {
  const std::vector<double> op = random_walk(1);
  EXPECT_EQ(positions({0.0, 0.0, GetParam()}, op), op);
}

TEST_P(BothLaws, RestsUntilTheBandIsPassedThenJumps) {
  // From 50 up: the first motion of a valve that rested asks for more than the band (choudhury) or
  // the jump (kano), then mv = op - (S - J) / 2.
  const std::vector<double> op = {50.0, 51.0, 52.0, 53.0, 54.0};
  const std::vector<double> mv = positions({3.0, 1.0, GetParam()}, op);
  EXPECT_EQ(mv[1], 50.0);
  EXPECT_EQ(mv[4], 53.0);
}

TEST_P(BothLaws, AReversalCostsTheWholeBand) {
  // Moving up to 60, then down by steps of 1/2: it rests until op has come down by more than 3.
  std::vector<double> op = {50.0, 55.0, 60.0};
  for (double value = 59.5; value >= 56.5; value -= 0.5) {
    op.push_back(value);
  }
  const std::vector<double> mv = positions({3.0, 1.0, GetParam()}, op);
  EXPECT_EQ(mv[2], 59.0);
  EXPECT_EQ(mv[8], 59.0);  // op = 57.0: exactly 3 below the stop, not more
  EXPECT_EQ(mv[9], 57.5);  // op = 56.5: 56.5 + (3 - 1) / 2
}

TEST(ValveStiction, KanosValveNeverStraysFurtherThanTheLawAllows) {
  const std::vector<double> op = random_walk(5);
  const std::vector<double> mv = positions({3.0, 1.0, StictionLaw::kano}, op);
  for (std::size_t k = 0; k < op.size(); ++k) {
    // At rest op may lie S from the stop, where mv was (S - J) / 2 away.
    ASSERT_LE(std::abs(op[k] - mv[k]), 3.0 + 1.0 + 1e-9);
  }
}

TEST(ValveStiction, SmallReversalsHoldThePrintedValveButNotKanos) {
  // op climbs in a saw of 0.5 up, 0.3 down: the printed flow chart starts counting anew at every
  // turn and never reaches 3; Kano's valve counts from where it stopped.
  std::vector<double> op = {50.0};
  for (int tooth = 0; tooth < 100; ++tooth) {
    op.push_back(op.back() + 0.5);
    op.push_back(op.back() - 0.3);
  }
  EXPECT_EQ(positions({3.0, 1.0, StictionLaw::choudhury}, op).back(), 50.0);
  EXPECT_GT(positions({3.0, 1.0, StictionLaw::kano}, op).back(), 65.0);
}

TEST(ValveStiction, APauseInOneDirectionCostsKanosValveTheJumpOnly) {
  const std::vector<double> op = {50.0, 55.0, 56.0, 56.0, 56.0, 57.5};
  EXPECT_EQ(positions({3.0, 1.0, StictionLaw::kano}, op).back(), 56.5);
  EXPECT_EQ(positions({3.0, 1.0, StictionLaw::choudhury}, op).back(), 55.0);
}

TEST(ValveStiction, RefusesAJumpLargerThanTheBand) {
  EXPECT_THROW(StickingValve(ValveStiction{1.0, 2.0, StictionLaw::kano}), std::invalid_argument);
  EXPECT_THROW(StickingValve(ValveStiction{-1.0, 0.0, StictionLaw::kano}), std::invalid_argument);
  EXPECT_THROW(StickingValve(ValveStiction{std::nan(""), 0.0, StictionLaw::kano}),
               std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::simulate
