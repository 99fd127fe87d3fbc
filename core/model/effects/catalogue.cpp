#include "core/model/effects/catalogue.hpp"

#include <algorithm>
#include <array>

#include "core/model/effects/curvature.hpp"
#include "core/model/effects/external_oscillation.hpp"
#include "core/model/effects/gain_change.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/model/effects/saturation.hpp"
#include "core/model/effects/sensor.hpp"
#include "core/model/effects/valve.hpp"

namespace loopscope::core::model {
namespace {

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

}  // namespace loopscope::core::model
