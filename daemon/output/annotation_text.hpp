#pragma once

#include <string>
#include <vector>

#include "daemon/text/time_zone.hpp"
#include "storage/results/catalogue/annotations.hpp"

namespace loopscope::daemon {

/// What holds, a line each, under a line of headings; a sentence where nothing does.
[[nodiscard]] std::string annotation_table(const std::vector<storage::Annotation>& annotations,
                                           const TimeZone& zone);

/// "suppressed FIC101, whatever the verdict, until 2026-05-01T00:00:00Z".
[[nodiscard]] std::string annotation_line(const storage::Annotation& annotation,
                                          const TimeZone& zone);

/// What else was said of the loop, a line each: what the new annotation takes the place of, what it
/// stands beside, by whom, since when and why; empty where nothing was.
[[nodiscard]] std::string others_in_force(const storage::OthersInForce& others,
                                          const TimeZone& zone);

}  // namespace loopscope::daemon
