#pragma once

#include "core/diagnosis/analysis_settings.hpp"
#include "core/signal/loop_window.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// What the catalogue says of a loop that its diagnosis uses, with the seed of this window: the
/// same for service, report and replay, so that they give the same verdict.
[[nodiscard]] core::LoopFacts loop_facts(const storage::CatalogueEntry& loop,
                                         const core::signal::LoopWindow& window);

}  // namespace loopscope::daemon
