#pragma once

#include "daemon/report/page/fields.hpp"
#include "daemon/report/sections/loop_section.hpp"

namespace loopscope::daemon {

/// What the loop's data are worth: what is wrong with them and what mends it, and the figures of
/// the window.
[[nodiscard]] Markup data_section(const LoopReport& loop_report);

}  // namespace loopscope::daemon
