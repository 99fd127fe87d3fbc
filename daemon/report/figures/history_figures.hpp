#pragma once

#include <span>
#include <vector>

#include "daemon/report/figures/figure.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// NGI and NLI, Harris index and standard deviation of the error over the slots of a loop; nothing
/// with fewer than two slots.
[[nodiscard]] std::vector<Figure> history_figures(std::span<const storage::HistoryPoint> history,
                                                  const TimeZone& zone);

}  // namespace loopscope::daemon
