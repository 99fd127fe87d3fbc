#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "daemon/report/page/fields.hpp"
#include "daemon/report/text/loop_links.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// The work list as a table; runs that began after `since_us` are marked as new. A live page shows
/// the first `kMostRanked` and leads to the others; a report has all, to be sorted and filtered.
[[nodiscard]] Markup ranked_list(const std::vector<storage::FlaggedRow>& flagged,
                                 std::int64_t since_us, const LoopLinks& links,
                                 const TimeZone& zone);

/// As many rows as a page of a plant is read for; the others stand in the list of all loops.
inline constexpr std::size_t kMostRanked = 50;

}  // namespace loopscope::daemon
