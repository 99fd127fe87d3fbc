#pragma once

#include <string>

#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// Who follows whom in a shared oscillation, as a figure of HTML: the source first, the others in
/// the order of their lag, twelve loops at most, and an arrow from each loop's strongest leader to
/// it. Drawn without a plotting program, since the boxes hold names. Empty where the round did not
/// keep who foretells whom.
[[nodiscard]] std::string follow_map(const storage::PlantOscillationRow& event);

}  // namespace loopscope::daemon
