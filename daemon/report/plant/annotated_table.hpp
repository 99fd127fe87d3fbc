#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "daemon/report/page/fields.hpp"
#include "daemon/report/text/loop_links.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// What ends it, in as many words as `annotate list`: a time, "work is entered", "withdrawn".
[[nodiscard]] std::string until_words(const std::string& kind,
                                      const std::optional<std::int64_t>& until_us,
                                      const TimeZone& zone);

/// What people took off the list: verdict, who said what of it and why, until when; the newest
/// ones, the others counted. Empty where there is none.
[[nodiscard]] Markup annotated_table(const storage::PlantCounts& counts, const LoopLinks& links,
                                     const TimeZone& zone);

}  // namespace loopscope::daemon
