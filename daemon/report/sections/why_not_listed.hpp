#pragma once

#include <string>
#include <vector>

#include "daemon/report/page/fields.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// Why a loop with a fault is not on the list, and what to do instead: entries of its list of
/// findings, HTML. "" = nothing hides it. `annotate_address`: where what people said is withdrawn;
/// empty = not on a page.
[[nodiscard]] Markup why_not_listed(const std::vector<storage::HiddenRow>& hidden,
                                    const TimeZone& zone, const std::string& annotate_address = {});

}  // namespace loopscope::daemon
