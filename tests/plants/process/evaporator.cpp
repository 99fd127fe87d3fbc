#include "tests/plants/process/evaporator.hpp"

namespace loopscope::tests::process {
namespace {

constexpr double kSecondsAMinute = 60.0;
constexpr double kSeparator = 20.0;     // kg/m, of level, and kg of liquor
constexpr double kVapourSpace = 4.0;    // kg/kPa
constexpr double kChestHold = 0.02;     // kg/kPa; not published, the chest follows in half a minute
constexpr double kTankHold = 60.0;      // kg/m; not published
constexpr double kHeatOfVapour = 38.5;  // kW min/kg
constexpr double kHeatOfSteam = 36.6;
constexpr double kHeatCapacity = 0.07;  // kW min/(kg K)
constexpr double kCondenser = 6.84;     // kW/K

}  // namespace

Evaporator::Stage Evaporator::stage(const Contents& at, const Inputs& in) {
  Stage s{};
  s.t2 = 0.5616 * at.p2 + 0.3126 * at.x2 + 48.43;
  s.t3 = 0.507 * at.p2 + 55.0;
  s.t100 = 0.1538 * at.p100 + 90.0;
  s.q100 = 0.16 * (in.f1 + in.f3) * (s.t100 - s.t2);
  s.f100 = s.q100 / kHeatOfSteam;
  s.f4 = (s.q100 - kHeatCapacity * in.f1 * (s.t2 - in.t1)) / kHeatOfVapour;
  s.q200 = kCondenser * (s.t3 - in.t200) / (1.0 + kCondenser / (2.0 * kHeatCapacity * in.f200));
  s.t201 = in.t200 + s.q200 / (kHeatCapacity * in.f200);
  s.f5 = s.q200 / kHeatOfVapour;
  return s;
}

Evaporator::Contents Evaporator::slope(const Contents& at, const Inputs& in) {
  const Stage s = stage(at, in);
  return {.l2 = (in.f1 - s.f4 - in.f2) / kSeparator,
          .x2 = (in.f1 * in.x1 - in.f2 * at.x2) / kSeparator,
          .p2 = (s.f4 - s.f5) / kVapourSpace,
          .p100 = (in.steam - s.f100) / kChestHold,
          .feed_tank = (in.inflow - in.f1) / kTankHold};
}

void Evaporator::step(const std::vector<double>& flows, const std::vector<double>& upsets,
                      double step_s) {
  const Inputs in{.f1 = flows[kF1Feed],
                  .f2 = flows[kF2Product],
                  .f3 = flows[kF3Circulation],
                  .f200 = flows[kF200Coolant],
                  .steam = flows[kSteam],
                  .x1 = 5.0 + upsets[kX1],
                  .t1 = 40.0 + upsets[kT1],
                  .t200 = 25.0 + upsets[kT200],
                  .inflow = 10.0 + upsets[kInflow]};
  const auto slope_of = [&in](const State<5>& at) -> State<5> {
    const Contents rate = slope({at[0], at[1], at[2], at[3], at[4]}, in);
    return {rate.l2, rate.x2, rate.p2, rate.p100, rate.feed_tank};
  };
  const State<5> next = runge_kutta<5>({now_.l2, now_.x2, now_.p2, now_.p100, now_.feed_tank},
                                       step_s / kSecondsAMinute, slope_of);
  now_ = {next[0], next[1], next[2], next[3], next[4]};
  t2_ = stage(now_, in).t2;
}

double Evaporator::value(std::size_t which) const {
  switch (which) {
    case kL2:
      return now_.l2;
    case kX2:
      return now_.x2;
    case kP2:
      return now_.p2;
    case kP100:
      return now_.p100;
    case kFeedTank:
      return now_.feed_tank;
    default:
      return t2_;
  }
}

}  // namespace loopscope::tests::process
