#pragma once

#include "config/settings.hpp"
#include "storage/loop_work.hpp"
#include "storage/results/reports/analysis_archive.hpp"

namespace loopscope::daemon {

/// Does a stored analysis again: the rows of its slot out of the historian, the settings that were
/// in force then, a loop model if there was one. `settings` say how the historian is reached.
/// Throws Failure when the historian has no row of the loop in that window any more (unusable_data)
/// and when the settings have no such historian (configuration), config::SettingsError for stored
/// settings that this program does not know, and storage::DatabaseError.
[[nodiscard]] storage::AnalysisRecord repeat_analysis(const config::Settings& settings,
                                                      const storage::StoredAnalysis& stored);

}  // namespace loopscope::daemon
