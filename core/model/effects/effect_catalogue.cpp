#include "core/model/effects/effect_catalogue.hpp"

#include <algorithm>
#include <array>

#include "core/model/effects/curvature.hpp"
#include "core/model/effects/external_oscillation.hpp"
#include "core/model/effects/gain_change.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/saturation.hpp"
#include "core/model/effects/valve.hpp"

namespace loopscope::core::model {
namespace {

/// What the sensor does is found by its residual tests alone (sensor_steps.hpp).
constexpr EffectTraits kCoarseGrid{.kind = EffectKind::sensor_quantisation,
                                   .word = "sensor_quantisation",
                                   .cause = EffectKind::sensor_hold,
                                   .place = Place::sensor};
constexpr EffectTraits kHeldValue{.kind = EffectKind::sensor_hold,
                                  .word = "sensor_hold",
                                  .cause = EffectKind::sensor_hold,
                                  .place = Place::sensor};

/// A line for each kind, in the order of EffectKind.
constexpr std::array kCatalogue = {
    kStiction,    kDeadband, kSaturation, kTrim,       kCurvedProcess,
    kOscillation, kLoadStep, kGainChange, kCoarseGrid, kHeldValue,
};

constexpr auto kKinds = [] {
  std::array<EffectKind, kCatalogue.size()> kinds{};
  std::ranges::transform(kCatalogue, kinds.begin(), &EffectTraits::kind);
  return kinds;
}();

constexpr bool in_order() {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (static_cast<std::size_t>(kKinds[i]) != i) return false;
  }
  return true;
}
static_assert(in_order());

}  // namespace

const EffectTraits& traits_of(EffectKind kind) {
  return kCatalogue[static_cast<std::size_t>(kind)];
}

std::span<const EffectKind> all_effect_kinds() {
  return kKinds;
}

std::string_view name(EffectKind kind) {
  return traits_of(kind).word;
}

bool is_valve_hysteresis(EffectKind kind) {
  return kind == EffectKind::valve_stiction || kind == EffectKind::valve_deadband;
}

bool bends_flow(EffectKind kind) {
  return traits_of(kind).place == Place::valve;
}

bool is_from_outside(EffectKind kind) {
  return traits_of(kind).place == Place::outside;
}

bool is_seen_without_op(EffectKind kind) {
  return is_from_outside(kind) || traits_of(kind).place == Place::sensor;
}

bool same_cause(EffectKind a, EffectKind b) {
  return traits_of(a).cause == traits_of(b).cause;
}

}  // namespace loopscope::core::model
