#include <cmath>
#include <gtest/gtest.h>

#include "tests/plants/process/column.hpp"
#include "tests/plants/process/evaporator.hpp"
#include "tests/plants/process/four_tanks.hpp"
#include "tests/plants/process/reactor_recycle.hpp"

namespace loopscope::tests::process {
namespace {

TEST(ProcessBalances, EvaporatorHasItsPublishedStage) {
  const Evaporator::Stage stage = Evaporator::stage({}, {});
  EXPECT_NEAR(stage.t2, 84.6, 0.05);
  EXPECT_NEAR(stage.t3, 80.6, 0.05);
  EXPECT_NEAR(stage.t100, 119.9, 0.06);
  EXPECT_NEAR(stage.q100, 339.0, 0.5);
  EXPECT_NEAR(stage.f100, 9.3, 0.05);
  EXPECT_NEAR(stage.f4, 8.0, 0.02);
  EXPECT_NEAR(stage.q200, 307.9, 0.3);
  EXPECT_NEAR(stage.t201, 46.1, 0.1);
  EXPECT_NEAR(stage.f5, 8.0, 0.01);
}

TEST(ProcessBalances, EvaporatorRestsAtItsPublishedState) {
  Evaporator::Inputs inputs;
  inputs.steam = Evaporator::stage({}, {}).f100;
  const Evaporator::Contents slope = Evaporator::slope({}, inputs);
  EXPECT_NEAR(slope.l2, 0.0, 1e-3);
  EXPECT_NEAR(slope.x2, 0.0, 1e-9);
  EXPECT_NEAR(slope.p2, 0.0, 5e-3);
  EXPECT_NEAR(slope.p100, 0.0, 1e-9);
}

TEST(ProcessBalances, TanksRestAtBothPublishedPoints) {
  const std::vector<double> none(6, 0.0);
  for (const FourTanks::Setting& setting :
       {FourTanks::kMinimumPhase, FourTanks::kNonminimumPhase}) {
    const std::vector<double> flows = {setting.flow_1, setting.flow_2, FourTanks::kBleedFlow,
                                       setting.transfer(), FourTanks::kBleedFlow};
    const auto& at = setting.levels;
    const FourTanks tanks(setting, 0.1);
    const State<6> slope = tanks.slope(
        {at[0], at[1], at[2], at[3], FourTanks::kSumpLevel, FourTanks::kSumpLevel}, flows, none);
    // The levels are published to a millimetre, the flows to one percent.
    for (const double rate : slope) EXPECT_NEAR(rate, 0.0, 0.012);
    EXPECT_NEAR(slope[4] + slope[5], 0.0, 0.01);
  }
}

TEST(ProcessBalances, ReactorRestsAtItsPublishedState) {
  const std::vector<double> none(7, 0.0);
  const std::vector<double> flows = {ReactorRecycle::kFreshFlow,   ReactorRecycle::kEffluentFlow,
                                     ReactorRecycle::kRecycleFlow, ReactorRecycle::kBottomsFlow,
                                     ReactorRecycle::kSteamFlow,   ReactorRecycle::kRefluxFlow,
                                     ReactorRecycle::kJacketFlow,  ReactorRecycle::kCondenserFlow};
  for (const double size : {1.0, 0.1}) {
    const ReactorRecycle plant(size);
    const ReactorRecycle::Contents slope = plant.slope(plant.nominal(), flows, none);
    EXPECT_NEAR(slope.reactor, 0.0, 1e-6);
    EXPECT_NEAR(slope.content, 0.0, 1e-3);
    EXPECT_NEAR(slope.temperature, 0.0, 0.5);  // F an hour
    EXPECT_NEAR(slope.jacket, 0.0, 2.0);
    EXPECT_NEAR(slope.base, 0.0, 1e-6);
    EXPECT_NEAR(slope.base_content, 0.0, 1e-3);
    EXPECT_NEAR(slope.drum_content, 0.0, 1e-3);
    EXPECT_NEAR(slope.pressure, 0.0, 1e-6);
  }
}

/// Of the column's values after a step of one stream from rest.
struct ColumnAnswer {
  double top, bottom;
};

ColumnAnswer answer_of_column(std::size_t stream, double step, double minutes) {
  std::vector<double> flows = {Column::kFeedFlow,       Column::kRefluxFlow,  Column::kSteamFlow,
                               Column::kDistillateFlow, Column::kBottomsFlow, Column::kCoolantFlow};
  flows[stream] += step;
  Column column(10.0);
  for (int k = 0; k < static_cast<int>(6.0 * minutes); ++k)
    column.step(flows, std::vector<double>(6, 0.0), 10.0);
  return {(column.value(Column::kTop) - Column::kTop0) / step,
          (column.value(Column::kBottom) - Column::kBottom0) / step};
}

TEST(ProcessBalances, ColumnHasThePublishedGainsAndDeadTimes) {
  const ColumnAnswer of_reflux = answer_of_column(Column::kReflux, 0.01, 200.0);
  EXPECT_NEAR(of_reflux.top, 12.8, 0.01);
  EXPECT_NEAR(of_reflux.bottom, 6.6, 0.01);
  const ColumnAnswer of_feed = answer_of_column(Column::kFeed, 0.01, 200.0);
  EXPECT_NEAR(of_feed.top, 3.8, 0.01);
  EXPECT_NEAR(of_feed.bottom, 4.9, 0.01);
  EXPECT_EQ(answer_of_column(Column::kReflux, 0.01, 6.9).bottom, 0.0);
  EXPECT_GT(answer_of_column(Column::kReflux, 0.01, 8.0).bottom, 0.0);
  EXPECT_NEAR(answer_of_column(Column::kReflux, 0.01, 17.7).top, 12.8 * (1.0 - std::exp(-1.0)),
              0.1);
}

TEST(ProcessBalances, ColumnAtRestStaysThere) {
  const ColumnAnswer rest = answer_of_column(Column::kCoolant, 1e-9, 100.0);
  EXPECT_NEAR(rest.top * 1e-9, 0.0, 1e-6);
  EXPECT_NEAR(rest.bottom * 1e-9, 0.0, 1e-6);
}

}  // namespace
}  // namespace loopscope::tests::process
