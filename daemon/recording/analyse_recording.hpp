#pragma once

#include <optional>

#include "core/diagnosis/diagnose.hpp"
#include "daemon/output/analysis_json.hpp"
#include "daemon/recording/recording.hpp"

namespace loopscope::daemon {

/// A recording's window, what is said of it as input, and its diagnosis.
struct RecordingAnalysis {
  core::signal::LoopWindow window;
  InputFacts input;
  core::Diagnosis diagnosis;
};

/// The last window of the recording (of what lies up to `end_us`, counted as its times), diagnosed
/// with what the file holds before it where a slow oscillation asks for more. The seed of `facts`
/// is that of the window. Throws as core::diagnose().
[[nodiscard]] RecordingAnalysis analyse_recording(
    const Recording& recording, const core::AnalysisSettings& settings,
    const std::optional<core::signal::OpRange>& op_range, core::LoopFacts facts = {},
    std::optional<std::int64_t> end_us = {});

}  // namespace loopscope::daemon
