#pragma once

#include <string>

#include "daemon/report/page/fields.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// Who follows whom in a shared oscillation, as a figure of HTML: the source first, the others in
/// the order of their lag, twelve loops at most, and an arrow from each loop's strongest leader to
/// it. Drawn without a plotting program, since the boxes hold names. Empty where the round did not
/// keep who foretells whom.
[[nodiscard]] Markup follow_map(const storage::PlantOscillationRow& event);

/// "30 s behind", "2 min ahead", within half a period of the source's swing; empty for the source,
/// and where none is named. Plain text.
[[nodiscard]] std::string lag_words(const storage::PlantOscillationRow::Member& member,
                                    const storage::PlantOscillationRow& event);

/// "affected loop" of `victim`. Plain text.
[[nodiscard]] std::string role_words(std::string_view role);

/// "affected loop, 30 s behind". Plain text.
[[nodiscard]] std::string role_and_lag(const storage::PlantOscillationRow::Member& member,
                                       const storage::PlantOscillationRow& event);

}  // namespace loopscope::daemon
