// The small effects: each has one law, and each test checks that law.
#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "core/simulate/effects/disturbance.hpp"
#include "core/simulate/effects/process_change.hpp"
#include "core/simulate/effects/sensor.hpp"
#include "core/simulate/effects/valve_deadband.hpp"
#include "core/simulate/effects/valve_travel.hpp"

namespace loopscope::core::simulate {
namespace {

TEST(ValveDeadband, HysteresisIsExactlyAsWideAsSaid) {
  ValveWithPlay valve({2.0});
  valve.next(50.0);
  EXPECT_EQ(valve.next(51.0), 50.0);  // still inside the play
  EXPECT_EQ(valve.next(60.0), 59.0);
  EXPECT_EQ(valve.next(58.0), 59.0);  // the whole width back: not moved yet
  EXPECT_EQ(valve.next(57.0), 58.0);
}

TEST(ValveDeadband, WithoutWidthIsTheIdentity) {
  ValveWithPlay valve({0.0});
  for (const double op : {50.0, 51.3, 50.2, 49.9}) {
    EXPECT_EQ(valve.next(op), op);
  }
}

TEST(ValveSaturation, ClipsTravelAndNothingElse) {
  const ValveSaturation saturation{20.0, 60.0};
  EXPECT_EQ(limited_travel(saturation, 10.0), 20.0);
  EXPECT_EQ(limited_travel(saturation, 33.3), 33.3);
  EXPECT_EQ(limited_travel(saturation, 99.0), 60.0);
  EXPECT_THROW(check(ValveSaturation{60.0, 20.0}), std::invalid_argument);
}

TEST(ValveCharacteristic, KeepsTheOperatingPointAndRises) {
  const ValveCharacteristic curved{0.5};
  EXPECT_EQ(flow_at(curved, 50.0), 50.0);
  for (double mv = 0.0; mv < 100.0; mv += 1.0) {
    EXPECT_GT(flow_at(curved, mv + 1.0), flow_at(curved, mv));
  }
  EXPECT_EQ(flow_at({0.0}, 12.5), 12.5);
  EXPECT_THROW(check(ValveCharacteristic{0.6}), std::invalid_argument);
}

TEST(ProcessNonlinearity, IsAParabolaUpToItsVertex) {
  const ProcessNonlinearity curved{0.5};
  EXPECT_DOUBLE_EQ(curved_answer(curved, 10.0), 11.0);
  EXPECT_DOUBLE_EQ(curved_answer(curved, -10.0), -9.0);
  EXPECT_DOUBLE_EQ(curved_answer(curved, -50.0), -25.0);
  EXPECT_DOUBLE_EQ(curved_answer(curved, -80.0), -25.0);
  EXPECT_DOUBLE_EQ(curved_answer({-0.5}, 80.0), 25.0);
  EXPECT_EQ(curved_answer({0.0}, 7.5), 7.5);
}

TEST(GainChange, StepsOrRampsToItsRatio) {
  const GainChange step{.at_s = 100.0, .ratio = 2.0};
  EXPECT_EQ(gain_factor(step, 99.0), 1.0);
  EXPECT_EQ(gain_factor(step, 100.0), 2.0);
  const GainChange falling{.at_s = 0.0, .ratio = 0.5, .rate_per_hour = 1.0};
  EXPECT_DOUBLE_EQ(gain_factor(falling, 900.0), 0.75);
  EXPECT_DOUBLE_EQ(gain_factor(falling, 7200.0), 0.5);
  EXPECT_THROW(check(GainChange{.ratio = 0.0}), std::invalid_argument);
}

TEST(Disturbance, SinusoidAndStep) {
  EXPECT_NEAR(disturbance_at(ExternalOscillation{100.0, 2.0}, 25.0), 2.0, 1e-12);
  EXPECT_NEAR(disturbance_at(ExternalOscillation{100.0, 2.0}, 100.0), 0.0, 1e-12);
  EXPECT_EQ(disturbance_at(LoadStep{10.0, -3.0}, 9.9), 0.0);
  EXPECT_EQ(disturbance_at(LoadStep{10.0, -3.0}, 10.0), -3.0);
  EXPECT_THROW(check(ExternalOscillation{0.0, 1.0}), std::invalid_argument);
}

TEST(SensorQuantisation, LiesOnTheGridAtMostHalfAStepAway) {
  const SensorQuantisation coarse{0.25};
  for (double pv = -3.0; pv < 3.0; pv += 0.037) {
    const double seen = quantised(coarse, pv);
    EXPECT_EQ(std::remainder(seen, 0.25), 0.0);
    EXPECT_LE(std::abs(seen - pv), 0.125);
  }
}

TEST(SensorHold, RenewsEverySoManySamples) {
  HoldingSensor sensor({3.0});
  const double seen[] = {1, 1, 1, 4, 4, 4, 7};
  for (int k = 0; k < 7; ++k) {
    EXPECT_EQ(sensor.next(k + 1.0), seen[k]);
  }
  EXPECT_THROW(HoldingSensor({2.5}), std::invalid_argument);
  EXPECT_THROW(HoldingSensor({0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::core::simulate
