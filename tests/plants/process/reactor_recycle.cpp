#include "tests/plants/process/reactor_recycle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace loopscope::tests::process {
namespace {

using R = ReactorRecycle;
using Contents = R::Contents;

constexpr double kHour_s = 3600.0;
constexpr double kHeatCapacity_lbmol = 40.0;  // Btu/(lbmol F)
constexpr double kReactionHeat = 12000.0;     // Btu/lbmol
constexpr double kActivation_per_f = 0.021;   // of the rate, about 140 F: E = 15 000 Btu/lbmol
constexpr double kFeedTemperature0 = 80.0, kRecycleTemperature = 130.0, kWater0 = 70.0;
constexpr double kJacketHold = 2350.0;  // lb of water
constexpr double kVapourFlow = R::kRefluxFlow + R::kRecycleFlow;
constexpr double kVapourByPsi = 4.0;      // lbmol/h that a psi more takes off the boil-up
constexpr double kCondensedByPsi = 60.0;  // lbmol/h
constexpr double kCondensedByFlow = 0.08;
constexpr double kCondensedByKelvin = 6.0;  // deg F of the water
constexpr double kVapourSpace_lbmol = 1.2;  // lbmol/psi
constexpr double kTrayByContent = 6.0;      // F, by the logarithm of the base's content
constexpr double kTrayByPsi = 1.5;

double odds(double content) {
  return content / (1.0 - content);
}

/// By the heat that is left over at the nominal state.
constexpr double kJacketHeat =
    (R::kFreshFlow * R::kFreshContent - R::kBottomsFlow * R::kBottomsContent) * kReactionHeat -
    kHeatCapacity_lbmol * (R::kFreshFlow * (R::kTemperature0 - kFeedTemperature0) +
                           R::kRecycleFlow * (R::kTemperature0 - kRecycleTemperature));
constexpr double kTransfer = kJacketHeat / (R::kTemperature0 - R::kJacket0);  // Btu/(h F)

/// Content of the vapour that leaves the top; more reflux separates better.
double top_content(double base_content, double reflux, double vapour) {
  const double nominal = odds(R::kRecycleContent) / odds(R::kBottomsContent);
  const double share = reflux / vapour * kVapourFlow / R::kRefluxFlow;
  const double factor = nominal * share * share * share;
  const double x = std::clamp(base_content, 0.0, 1.0);
  return factor * x / (1.0 + (factor - 1.0) * x);
}

double boil_up(const Contents& at, double steam) {
  return kVapourFlow * steam / R::kSteamFlow - kVapourByPsi * (at.pressure - R::kPressure0);
}

double condensed(const Contents& at, double water, double warmer) {
  return kVapourFlow + kCondensedByPsi * (at.pressure - R::kPressure0) +
         kCondensedByFlow * (water - R::kCondenserFlow) - kCondensedByKelvin * warmer;
}

}  // namespace

ReactorRecycle::ReactorRecycle(double size) : size_(size), now_(nominal()) {}

Contents ReactorRecycle::nominal() const {
  return {size_ * kReactorHold, kEffluentContent, kTemperature0,   kJacket0,  kBaseHold,
          kBottomsContent,      kDrumHold,        kRecycleContent, kPressure0};
}

Contents ReactorRecycle::slope(const Contents& at, const std::vector<double>& flows,
                               const std::vector<double>& upsets) const {
  const double rate = kRate_per_h / size_ * (1.0 + upsets[kActivity]) *
                      std::exp(kActivation_per_f * (at.temperature - kTemperature0));
  const double reacted = rate * at.reactor * at.content;
  const double fresh = flows[kFresh], recycle = flows[kRecycle], effluent = flows[kEffluent];
  const double feed_rise = at.temperature - kFeedTemperature0 - upsets[kFeedTemperature];
  const double to_jacket = kTransfer * (at.temperature - at.jacket);
  const double heat =
      reacted * kReactionHeat - to_jacket -
      kHeatCapacity_lbmol * (fresh * feed_rise + recycle * (at.temperature - kRecycleTemperature));
  const double warmer = upsets[kWaterTemperature];
  const double vapour = boil_up(at, flows[kSteam]);
  const double liquid = condensed(at, flows[kCondenserWater], warmer);
  const double top = top_content(at.base_content, flows[kReflux], vapour);
  return {
      .reactor = fresh + recycle - effluent,
      .content = (fresh * (kFreshContent + upsets[kFeedContent] - at.content) +
                  recycle * (at.drum_content - at.content) - reacted) /
                 at.reactor,
      .temperature = heat / (at.reactor * kHeatCapacity_lbmol),
      .jacket = (flows[kJacketWater] * (kWater0 + warmer - at.jacket) + to_jacket) / kJacketHold,
      .base = effluent + flows[kReflux] - vapour - flows[kBottoms],
      .base_content = (effluent * (at.content - at.base_content) +
                       flows[kReflux] * (at.drum_content - at.base_content) -
                       vapour * (top - at.base_content)) /
                      at.base,
      .drum = liquid - flows[kReflux] - recycle,
      .drum_content = liquid * (top - at.drum_content) / at.drum,
      .pressure = (vapour - liquid) / kVapourSpace_lbmol};
}

void ReactorRecycle::step(const std::vector<double>& flows, const std::vector<double>& upsets,
                          double step_s) {
  const auto slope_of = [&](const State<9>& at) {
    return std::bit_cast<State<9>>(slope(std::bit_cast<Contents>(at), flows, upsets));
  };
  now_ = std::bit_cast<Contents>(
      runge_kutta<9>(std::bit_cast<State<9>>(now_), step_s / kHour_s, slope_of));
  for (double* hold : {&now_.reactor, &now_.base, &now_.drum}) *hold = std::max(*hold, 1.0);
}

double ReactorRecycle::value(std::size_t which) const {
  switch (which) {
    case kReactorLevel:
      return 50.0 * now_.reactor / (size_ * kReactorHold);
    case kTemperature:
      return now_.temperature;
    case kJacket:
      return now_.jacket;
    case kDrum:
      return 50.0 * now_.drum / kDrumHold;
    case kBase:
      return 50.0 * now_.base / kBaseHold;
    case kTray:
      return kTray0 -
             kTrayByContent * std::log(std::max(1e-6, now_.base_content) / kBottomsContent) +
             kTrayByPsi * (now_.pressure - kPressure0);
    case kPressure:
      return now_.pressure;
    default:
      return 100.0 * now_.content;
  }
}

}  // namespace loopscope::tests::process
