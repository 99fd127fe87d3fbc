#pragma once

#include <cstddef>
#include <optional>

#include "core/diagnosis/odds/combined_odds.hpp"
#include "daemon/recording/analyse_recording.hpp"

namespace loopscope::daemon {

/// A recording longer than a window, judged by several: their odds are combined as those of a loop.
struct WindowsAnalysis {
  RecordingAnalysis newest;  ///< its verdict is that of all windows together
  std::size_t judged = 1;  ///< windows whose odds the verdict combines; 1 = the newest one's alone
  /// Of the newest window alone; nullopt = the verdict is its own already: no other window could be
  /// judged, or not this one.
  std::optional<core::diagnosis::Verdict> newest_alone = std::nullopt;
  double together = 1.0;  ///< windows that share no sample would weigh as much
};

/// Full windows, evenly spread over the recording and as few as cover it; of a longer recording the
/// last eight, beyond which a window's weight is less than a seventh. Throws as core::diagnose().
[[nodiscard]] WindowsAnalysis analyse_windows(const Recording& recording,
                                              const core::AnalysisSettings& settings,
                                              const std::optional<core::signal::OpRange>& op_range,
                                              const core::LoopFacts& facts = {});

}  // namespace loopscope::daemon
