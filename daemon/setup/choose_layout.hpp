#pragma once

#include <string>
#include <vector>

#include "daemon/setup/layout_candidate.hpp"
#include "daemon/setup/questions.hpp"

namespace loopscope::daemon {

/// The one layout of the historian's tables; where there are several, the one that is chosen.
/// Throws Failure: usage where it has to be said by options, unusable data where no table looks
/// like a history.
[[nodiscard]] LayoutCandidate choose_layout(const std::vector<storage::SeenTable>& tables,
                                            const LayoutWishes& wishes, Questions& questions);

/// What rows tell of a layout that its login may read: quality codes, units and zones of times.
/// Returns a note for each thing that somebody should look at. `time_zone` is that of local times,
/// empty = not said. Throws DatabaseError, and Failure (usage) for local times without their zone.
[[nodiscard]] std::vector<std::string> look_at_rows(storage::HistorianSurvey& survey,
                                                    const std::string& time_zone,
                                                    Questions& questions, LayoutCandidate& layout);

}  // namespace loopscope::daemon
