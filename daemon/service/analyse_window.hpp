#pragma once

#include <string>

#include "core/diagnosis/diagnose.hpp"
#include "daemon/service/loop_input.hpp"
#include "storage/analysis_record.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// Analyses one loop's input and adds the provenance that is stored with it. `settings_json` names
/// the settings in force; it is part of the digest, so that changed settings make a revision.
[[nodiscard]] storage::AnalysisRecord analyse_window(const storage::CatalogueEntry& loop,
                                                     const LoopInput& input,
                                                     const core::AnalysisSettings& settings,
                                                     const std::string& settings_json);

/// The digest that the record of this input carries: over the window and, where one was read, over
/// the longer span.
[[nodiscard]] std::string digest_of(const storage::CatalogueEntry& loop, const LoopInput& input,
                                    const std::string& settings_json);

}  // namespace loopscope::daemon
