#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "daemon/report/figures/event_pictures.hpp"
#include "daemon/report/figures/figure.hpp"
#include "daemon/report/page/fields.hpp"
#include "daemon/report/text/loop_links.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// One oscillation that loops share, as one box: period, odds of the source with what speaks for
/// and against, pictures, who follows whom, members; in a report folded. Without pictures, or of a
/// program of before, what there is.
[[nodiscard]] Markup event_box(const storage::PlantOscillationRow& event,
                               std::span<const Picture> pictures, const LoopLinks& links,
                               const TimeZone& zone);

/// All of them with the pictures of `album`; `picture_trouble`: why there are none, a sentence.
/// Empty where there is none.
[[nodiscard]] Markup event_boxes(std::span<const storage::PlantOscillationRow> events,
                                 const EventAlbum& album, const std::string& picture_trouble,
                                 const LoopLinks& links, const TimeZone& zone);

}  // namespace loopscope::daemon
