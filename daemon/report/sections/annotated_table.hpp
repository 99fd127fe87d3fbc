#pragma once

#include <string>

#include "daemon/report/page/fields.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// "Suppressed", "Marked as a false positive": behind it stands the name.
[[nodiscard]] std::string deed_words(const std::string& hidden_by);

/// What people took off the list: verdict, who said what of it and why, until when; the newest
/// ones, the others counted. Empty where there is none.
[[nodiscard]] Markup annotated_table(const storage::PlantCounts& counts, LoopLinks links,
                                     const TimeZone& zone);

}  // namespace loopscope::daemon
