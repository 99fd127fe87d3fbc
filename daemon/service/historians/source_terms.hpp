#pragma once

#include "config/settings.hpp"
#include "daemon/service/historians/historian_pool.hpp"

namespace loopscope::daemon {

/// A historian that failed is left alone for so long, so that its loops go on soon after it is
/// back.
[[nodiscard]] double source_pause_s(const config::ScheduleSettings& schedule);

/// What a reader of windows puts up with.
[[nodiscard]] SourceTerms source_terms(const config::ScheduleSettings& schedule);

}  // namespace loopscope::daemon
