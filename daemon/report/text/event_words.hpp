#pragma once

#include <string>

#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// "30 s behind", "2 min ahead", within half a period of the source's swing; empty for the source,
/// and where none is named. Plain text.
[[nodiscard]] std::string lag_words(const storage::PlantOscillationRow::Member& member,
                                    const storage::PlantOscillationRow& event);

/// "victim, 30 s behind". Plain text.
[[nodiscard]] std::string role_and_lag(const storage::PlantOscillationRow::Member& member,
                                       const storage::PlantOscillationRow& event);

}  // namespace loopscope::daemon
