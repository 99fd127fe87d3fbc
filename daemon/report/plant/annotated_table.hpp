#pragma once

#include "daemon/report/page/fields.hpp"
#include "daemon/report/text/loop_links.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// What people took off the list: verdict, who said what of it and why, until when; the newest
/// ones, the others counted. Empty where there is none.
[[nodiscard]] Markup annotated_table(const storage::PlantCounts& counts, const LoopLinks& links,
                                     const TimeZone& zone);

}  // namespace loopscope::daemon
