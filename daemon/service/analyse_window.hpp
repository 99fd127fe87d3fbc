#pragma once

#include <string>

#include "core/diagnosis/diagnose.hpp"
#include "daemon/service/window_reader.hpp"
#include "storage/analysis_record.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// Analyses one window and adds the provenance that is stored with it. `settings_json` names the
/// settings in force; it is part of the digest, so that changed settings make a revision.
[[nodiscard]] storage::AnalysisRecord analyse_window(const storage::CatalogueEntry& loop,
                                                     const LoopWindowAtSlot& at_slot,
                                                     const core::AnalysisSettings& settings,
                                                     const std::string& settings_json);

/// The digest that the record of this window carries.
[[nodiscard]] std::string digest_of(const storage::CatalogueEntry& loop,
                                    const LoopWindowAtSlot& at_slot,
                                    const std::string& settings_json);

}  // namespace loopscope::daemon
