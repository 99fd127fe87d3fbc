#pragma once

#include <cstddef>
#include <optional>

#include "core/model/selection/candidate_fit.hpp"

namespace loopscope::core::model {

/// A valve that has entered, but that the tests which asked for it still see: its needle was missed
/// (stiction_search.hpp). It is looked for again between the samples, behind the process of
/// `settled`, which it showed well enough for the right one to show. One that acts at the samples
/// is looked for by either law, between them the two move so differently that the one which leads
/// is right.
///
/// `settled` ends with that valve; each `attempt` has first guesses of its own. nullopt where
/// nothing is found that is worth more.
[[nodiscard]] std::optional<CandidateFit> refine_valve(const CandidateFit& entered,
                                                       const Fit& settled, std::size_t attempt);

}  // namespace loopscope::core::model
