#pragma once

#include <vector>

#include "core/model/selection/candidate_fit.hpp"

namespace loopscope::core::model {

/// A valve that stops short, a curved valve or a curved process.
[[nodiscard]] bool is_bend(EffectKind kind);

/// Puts the likeliest of the bends first, where
/// one of them leads; only those come into question that would be taken in alone. At rest they are
/// nearly the same, and what tells them apart is how pv goes from one level to the next, a few
/// percent of the rows. So they are compared on all rows, fitted jointly, and not on rows held out:
/// that there is a bend is known by then.
void locate_static_nonlinearity(const LoopData& data, std::vector<CandidateFit>& trials);

}  // namespace loopscope::core::model
