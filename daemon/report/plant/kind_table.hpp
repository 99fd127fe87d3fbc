#pragma once

#include <cstdint>
#include <span>

#include "daemon/report/page/fields.hpp"
#include "daemon/report/text/loop_links.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// The kinds of fault on the work list, the one of the worst loop first, each with how many loops
/// have it and what is to be done: said once, in general; a loop's own page tells it with the
/// figures of the loop. Empty where nothing is flagged.
[[nodiscard]] Markup kind_table(std::span<const storage::FlaggedRow> flagged, std::int64_t since_us,
                                const LoopLinks& links);

}  // namespace loopscope::daemon
