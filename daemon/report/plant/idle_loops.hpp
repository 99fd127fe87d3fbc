#pragma once

#include "daemon/report/page/fields.hpp"
#include "daemon/report/text/loop_links.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// Loops on which no controller acts, and loops that cannot be judged with the reason: of each the
/// first `kMostIdle`, the others counted. Empty where there is none.
[[nodiscard]] Markup idle_loops(const storage::PlantCounts& counts, const LoopLinks& links,
                                const TimeZone& zone);

/// Rows of each of the two tables: in a shutdown whole areas stand in them.
inline constexpr std::size_t kMostIdle = 25;

}  // namespace loopscope::daemon
