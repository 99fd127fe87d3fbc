#pragma once

#include <string>

#include "daemon/report/evidence/loop_evidence.hpp"
#include "daemon/report/page/fields.hpp"
#include "daemon/text/time_zone.hpp"

namespace loopscope::daemon {

/// The window as its rows were read onto the grid, for the trend of a live page, which is drawn by
/// page/trend and can be zoomed; hidden where no script runs. Every sample with six digits of its
/// value, 22 kB or less for each series of 4096 samples. Numbers are an attribute of the element;
/// `pv_unit` (empty = unknown) and the names of the zone's clocks are texts.
[[nodiscard]] Markup live_trend(const LoopEvidence& evidence, const std::string& pv_unit,
                                const TimeZone& zone);

}  // namespace loopscope::daemon
