#pragma once

#include <vector>

#include "daemon/report/page/fields.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// Every loop of the catalogue as a table that can be sorted and filtered, each with a link to its
/// page: verdict, confidence, whether it is flagged and, if not, what hides it, and whether the
/// monitor does its work there.
[[nodiscard]] Markup loop_list(const std::vector<storage::LoopRow>& loops, const TimeZone& zone);

}  // namespace loopscope::daemon
