#pragma once

#include <cstdint>
#include <vector>

#include "daemon/report/page/fields.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// The work list as a table, with every factor of the score; runs that began after `since_us` are
/// marked as new.
[[nodiscard]] Markup ranked_list(const std::vector<storage::FlaggedRow>& flagged,
                                 std::int64_t since_us, LoopLinks links, const TimeZone& zone);

}  // namespace loopscope::daemon
