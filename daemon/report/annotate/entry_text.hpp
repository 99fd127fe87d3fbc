#pragma once

#include <string>
#include <vector>

#include "daemon/text/time_zone.hpp"
#include "storage/results/catalogue/annotations.hpp"

namespace loopscope::daemon {

/// What was entered, as a page says it: "Entered: acknowledged, verdict valve stiction, until work
/// is entered."
[[nodiscard]] std::string entered_sentence(const storage::Annotation& annotation,
                                           const TimeZone& zone);

/// What else was said of the loop, a sentence each: "Takes the place of what was in force already:
/// acknowledged by J. Doe (login ls) since 2026-03-01 13:00 CET, ...", "Stands beside ...".
[[nodiscard]] std::vector<std::string> others_told(const storage::OthersInForce& others,
                                                   const TimeZone& zone);

}  // namespace loopscope::daemon
