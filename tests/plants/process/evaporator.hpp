#pragma once

#include "tests/plants/process/plan.hpp"
#include "tests/plants/process/random.hpp"

namespace loopscope::tests::process {

/// The forced-circulation evaporator of Newell and Lee (Applied Process Control, 1989), its
/// equations and nominal state as published (kg/min, kPa, deg C, %, kW), behind a feed tank and
/// with a steam chest that holds steam.
class Evaporator : public UnitProcess {
 public:
  enum Stream : std::size_t { kF1Feed, kF2Product, kF3Circulation, kF200Coolant, kSteam };
  enum Upset : std::size_t { kX1, kT1, kT200, kInflow, kSteamHeader, kWaterHeader, kFeedHead };
  enum Value : std::size_t { kL2, kX2, kP2, kP100, kFeedTank, kT2 };

  void step(const std::vector<double>& flows, const std::vector<double>& upsets,
            double step_s) override;
  [[nodiscard]] double value(std::size_t which) const override;

  /// All that the published equations make of a state.
  struct Stage {
    double t2, t3, t100, q100, f100, f4, q200, f5, t201;
  };
  struct Inputs {
    double f1 = 10.0, f2 = 2.0, f3 = 50.0, f200 = 208.0, steam = 0.0;
    double x1 = 5.0, t1 = 40.0, t200 = 25.0, inflow = 10.0;
  };
  struct Contents {
    double l2 = 1.0, x2 = 25.0, p2 = 50.5, p100 = 194.7, feed_tank = 1.0;
  };
  [[nodiscard]] static Stage stage(const Contents& at, const Inputs& in);
  /// Per minute.
  [[nodiscard]] static Contents slope(const Contents& at, const Inputs& in);

 private:
  Contents now_;
  double t2_ = 84.6;
};

[[nodiscard]] PlantPlan draft_evaporator(std::uint64_t seed);

}  // namespace loopscope::tests::process
