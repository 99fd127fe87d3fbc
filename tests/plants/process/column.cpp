#include "tests/plants/process/column.hpp"

#include <cmath>

namespace loopscope::tests::process {
namespace {

constexpr double kMinute_s = 60.0;
constexpr double kVapourPerSteam = Column::kVapour / Column::kSteamFlow;
constexpr double kVapourHold = 0.4;          // lb/psi
constexpr double kCondensedPerPsi = 0.5;     // lb/min a psi of pressure
constexpr double kCondensedPerFlow = 0.025;  // lb/min a lb/min of coolant
constexpr double kCondensedPerKelvin = 0.03;
constexpr double kSteamPerPsi = 0.06;     // lb/min of steam that a psi more is worth less
constexpr double kSteamPerBottoms = 0.2;  // that hot bottoms spare, lb/lb
constexpr double kSubcooling = 0.08;      // of reflux, by the fraction of more coolant

DelayedLag lag_in_minutes(double gain, double time_constant, double dead_time, double step_s) {
  return {gain, kMinute_s * time_constant, kMinute_s * dead_time, step_s};
}

/// The linear model knows no pure product: what remains to it is halved again and again.
double bounded(double room, double towards) {
  const double half = room / 2.0;
  return towards < half ? room - towards : half * std::exp(1.0 - towards / half);
}

}  // namespace

Column::Column(double step_s)
    : on_top_{lag_in_minutes(12.8, 16.7, 1.0, step_s), lag_in_minutes(-18.9, 21.0, 3.0, step_s),
              lag_in_minutes(3.8, 14.9, 8.1, step_s), lag_in_minutes(0.25, 14.9, 8.1, step_s)},
      on_bottom_{lag_in_minutes(6.6, 10.9, 7.0, step_s), lag_in_minutes(-19.4, 14.4, 3.0, step_s),
                 lag_in_minutes(4.9, 13.2, 3.4, step_s), lag_in_minutes(0.2, 13.2, 3.4, step_s)},
      down_(1.0, 90.0, 0.0, step_s),
      preheat_(kSteamPerBottoms, 60.0, 0.0, step_s),
      vessels_{kDrumFull / 2.0, kBaseFull / 2.0, kPressure0, kTankFull / 2.0},
      values_{kTop0, kBottom0, 50.0, 50.0, kPressure0, 50.0} {}

void Column::step(const std::vector<double>& flows, const std::vector<double>& upsets,
                  double step_s) {
  const double more_coolant = flows[kCoolant] / kCoolantFlow - 1.0;
  const double reflux = flows[kReflux] * (1.0 + kSubcooling * more_coolant) - kRefluxFlow;
  const double preheat = preheat_.step(flows[kBottoms] - kBottomsFlow);
  const double steam =
      flows[kSteam] - kSteamFlow - kSteamPerPsi * (vessels_[2] - kPressure0) + preheat;
  move_contents(reflux, steam, flows[kFeed] - kFeedFlow, upsets[kFeedContent]);
  move_vessels(flows, upsets, step_s / kMinute_s);
}

void Column::move_contents(double reflux, double steam, double feed, double feed_content) {
  const std::array inputs = {reflux, steam, feed, feed_content};
  double top = 0.0, bottom = 0.0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    top += on_top_[i].step(inputs[i]);
    bottom += on_bottom_[i].step(inputs[i]);
  }
  values_[kTop] = 100.0 - bounded(100.0 - kTop0, top);
  values_[kBottom] = bounded(kBottom0, -bottom);
}

void Column::move_vessels(const std::vector<double>& flows, const std::vector<double>& upsets,
                          double minutes) {
  const double down =
      kRefluxFlow + kFeedFlow + down_.step(flows[kReflux] - kRefluxFlow + flows[kFeed] - kFeedFlow);
  const auto slope = [&](const State<4>& at) -> State<4> {
    const double rise = at[2] - kPressure0;
    const double vapour =
        kVapourPerSteam * (flows[kSteam] - kSteamPerPsi * rise + preheat_.value());
    const double condensed = kVapour + kCondensedPerPsi * rise +
                             kCondensedPerFlow * (flows[kCoolant] - kCoolantFlow) -
                             kCondensedPerKelvin * upsets[kCoolantTemperature];
    return {condensed - flows[kReflux] - flows[kDistillate], down - vapour - flows[kBottoms],
            (vapour - condensed) / kVapourHold, kFeedFlow + upsets[kInflow] - flows[kFeed]};
  };
  vessels_ = runge_kutta<4>(vessels_, minutes, slope);
  values_[kDrum] = 100.0 * vessels_[0] / kDrumFull;
  values_[kBase] = 100.0 * vessels_[1] / kBaseFull;
  values_[kPressure] = vessels_[2];
  values_[kFeedTank] = 100.0 * vessels_[3] / kTankFull;
}

}  // namespace loopscope::tests::process
