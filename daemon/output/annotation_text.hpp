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

}  // namespace loopscope::daemon
