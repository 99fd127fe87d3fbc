#pragma once

#include <string>

#include "core/diagnosis/diagnose.hpp"

namespace loopscope::config {

/// The analysis part as a JSON object with every key, for provenance (stored with each analysis).
/// As the section "analysis" of a settings file it gives back the same settings to the last bit.
[[nodiscard]] std::string analysis_settings_json(const core::AnalysisSettings& settings);

/// The settings in such an object, in whatever order its keys stand; a key that it lacks has its
/// default. Throws SettingsError (read_settings.hpp) for a key or value that this program does not
/// know.
[[nodiscard]] core::AnalysisSettings parse_analysis_settings(const std::string& json);

}  // namespace loopscope::config
