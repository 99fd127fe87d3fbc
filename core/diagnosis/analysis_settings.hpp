#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/hos/transforms/settings.hpp"
#include "core/loop/oscillation.hpp"
#include "core/loop/performance.hpp"
#include "core/model/results/mechanism.hpp"
#include "core/signal/prepare.hpp"

namespace loopscope::core {

/// What is known of a loop beside its samples.
struct LoopFacts {
  bool integrating = false;  ///< level loop: the vessel integrates
  /// Of the simulations behind p-values (core/hos/surrogates/significance.hpp); made from the loop
  /// and the window, so that a replay is identical.
  std::uint64_t seed = 0;
  /// Width of the transmitter's range, pv units, > 0; nullopt = not known.
  std::optional<double> pv_span = std::nullopt;
  double pv_low = 0.0;       ///< its low end, pv units; counts where the width is known
  model::Without without{};  ///< tests only
};

/// Whether a loop of this type, as the catalogue spells it, integrates: "level" in any case does.
[[nodiscard]] bool is_integrating_type(std::string_view loop_type);

/// Settings of the whole analysis; each room documents its own.
struct AnalysisSettings {
  signal::PrepareSettings prepare;
  hos::Settings hos;
  loop::OscillationSettings oscillation;
  loop::PerformanceSettings performance;
  diagnosis::DecisionSettings decision;
  bool fit_model = true;  ///< false = statistics and shapes only
};

}  // namespace loopscope::core
