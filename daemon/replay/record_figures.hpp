#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "storage/loop_work.hpp"

namespace loopscope::daemon {

/// What a record says, in the shape of storage::StoredAnalysis::figures_json.
/// `measured_columns` are those of storage::AnalysisArchive for this record.
[[nodiscard]] nlohmann::json record_figures(const storage::AnalysisRecord& record,
                                            const std::string& measured_columns);

}  // namespace loopscope::daemon
