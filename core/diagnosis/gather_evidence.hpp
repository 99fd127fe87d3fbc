#pragma once

#include "core/diagnosis/analysis_settings.hpp"
#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/first_look.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core {

/// Everything that is measured on a window, but for the loop model: statistics of the error, wave
/// shapes, performance. The segments may make a window unusable that the first look let pass
/// (`data_quality.usable`). Throws and takes `long_window` as diagnose() does.
[[nodiscard]] Evidence gather_evidence(const FirstLook& first, const AnalysisSettings& settings,
                                       const LoopFacts& facts,
                                       const signal::LoopWindow* long_window = nullptr);

}  // namespace loopscope::core
