#pragma once

#include <vector>

#include "daemon/report/figures/figure.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// A shared oscillation in two pictures: trends of the loops that it shakes most on one time axis,
/// and their spectra over the period, each curve in a row of its own under the number that the loop
/// has in the event's list of members (from 1). Empty where the round kept no traces.
[[nodiscard]] std::vector<Figure> event_figures(const storage::PlantOscillationRow& event,
                                                const TimeZone& zone);

}  // namespace loopscope::daemon
