#pragma once

#include <string>

#include "core/diagnosis/diagnose.hpp"

namespace loopscope::config {

/// The analysis part as a JSON object with every key, for provenance (stored with each analysis).
/// As the section "analysis" of a settings file it gives back the same settings to the last bit.
[[nodiscard]] std::string analysis_settings_json(const core::AnalysisSettings& settings);

}  // namespace loopscope::config
