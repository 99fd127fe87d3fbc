#pragma once

#include <string>

#include "daemon/report/page/fields.hpp"
#include "daemon/report/sections/loop_section.hpp"

namespace loopscope::daemon {

/// Whether the loop is sound by itself and shaken by others: then it is shown as such, and not as
/// healthy.
[[nodiscard]] bool is_only_shaken(const LoopReport& loop_report);

/// The code that the heading shows.
[[nodiscard]] std::string shown_code(const LoopReport& loop_report);

/// "62 % of its error follows plant-wide oscillation 1 of FIC101 (period 40 s)".
[[nodiscard]] Markup follow_sentence(const storage::FollowedRow& followed);

}  // namespace loopscope::daemon
