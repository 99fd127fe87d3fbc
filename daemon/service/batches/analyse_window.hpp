#pragma once

#include <string>

#include "core/diagnosis/diagnose.hpp"
#include "daemon/service/batches/model_turns.hpp"
#include "daemon/service/windows/loop_input.hpp"
#include "storage/analysis_record.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// Analyses one loop's input and adds the provenance that is stored with it, and what each stage
/// took. `settings_json` names the settings in force; it is part of the digest, so that changed
/// settings make a revision. A model is fitted where the settings allow one and `wish` asks for it.
[[nodiscard]] storage::AnalysisRecord analyse_window(const storage::CatalogueEntry& loop,
                                                     const LoopInput& input,
                                                     const core::AnalysisSettings& settings,
                                                     const std::string& settings_json,
                                                     const ModelPolicy& wish = {});

/// The digest that the record of this input carries: over the window and, where one was read, over
/// the longer span.
[[nodiscard]] std::string digest_of(const storage::CatalogueEntry& loop, const LoopInput& input,
                                    const std::string& settings_json);

}  // namespace loopscope::daemon
