#pragma once

#include "daemon/report/page/fields.hpp"
#include "daemon/report/sections/loop_query.hpp"
#include "daemon/text/time_zone.hpp"

namespace loopscope::daemon {

/// A page of the catalogue's loops as a table, each with a link to its page: verdict, confidence,
/// whether it is flagged and, if not, what hides it, and whether the monitor does its work there.
/// Above it what was asked for, to be asked otherwise; its headers and the lines below lead to the
/// other orders and pages.
[[nodiscard]] Markup loop_list(const LoopListing& listing, const LoopQuery& query,
                               const TimeZone& zone);

}  // namespace loopscope::daemon
