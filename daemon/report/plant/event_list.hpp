#pragma once

#include <span>

#include "daemon/report/page/fields.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// The oscillations that loops share, one in a row, each with a link to its page (`/oscillation`).
/// Empty where there is none.
[[nodiscard]] Markup event_list(std::span<const storage::PlantOscillationRow> events);

/// Where one probably comes from: the loop or the outside with its probability, "unknown" where
/// neither is known.
[[nodiscard]] std::string source_words(const storage::PlantOscillationRow& event);

}  // namespace loopscope::daemon
