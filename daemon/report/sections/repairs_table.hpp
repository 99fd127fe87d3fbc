#pragma once

#include <string>
#include <vector>

#include "daemon/report/page/fields.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// What was done, what became of it in one word, why, and the figures before and after; of one loop
/// in `pv_unit` where it is known (empty = not, or of several loops).
[[nodiscard]] Markup repairs_table(const std::vector<storage::RepairRow>& repairs,
                                   const TimeZone& zone, const std::string& pv_unit = {});

}  // namespace loopscope::daemon
