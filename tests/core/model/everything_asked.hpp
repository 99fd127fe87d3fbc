#pragma once

#include <vector>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"

namespace loopscope::core::model::tests {

/// As if residual tests asked for every effect, with no place to start from.
[[nodiscard]] inline Nominations everything_asked() {
  std::vector<Nomination> all;
  for (const EffectKind kind : all_effect_kinds()) {
    if (kind != EffectKind::external_oscillation) all.push_back({.effect = kind, .p = 1e-6});
  }
  return Nominations(std::span<const Nomination>(all));
}

}  // namespace loopscope::core::model::tests
