#pragma once

#include <cstdint>
#include <span>

#include "daemon/report/figures/figure.hpp"
#include "daemon/report/page/fields.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// One oscillation that loops share, as one box: period, odds of the source with what speaks for
/// and against, pictures, who follows whom, members. `flagged` = the work list: in a report only
/// its loops have a section to link to. Without pictures, or of a program of before, what there is.
[[nodiscard]] Markup event_box(const storage::PlantOscillationRow& event,
                               std::span<const Picture> pictures,
                               std::span<const storage::FlaggedRow> flagged, LoopLinks links,
                               const TimeZone& zone);

}  // namespace loopscope::daemon
