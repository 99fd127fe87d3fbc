#pragma once

#include <vector>

#include "daemon/report/page/fields.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// What was done, what became of it in one word, why, and the figures before and after.
[[nodiscard]] Markup repairs_table(const std::vector<storage::RepairRow>& repairs,
                                   const TimeZone& zone);

}  // namespace loopscope::daemon
