#pragma once

#include "core/diagnosis/verdicts/decision_settings.hpp"
#include "core/hos/transforms/settings.hpp"
#include "core/loop/oscillation.hpp"
#include "core/loop/performance.hpp"
#include "core/signal/prepare.hpp"

namespace loopscope::core {

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
