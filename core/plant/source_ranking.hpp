#pragma once

#include <span>
#include <vector>

#include "core/plant/source_evidence.hpp"

namespace loopscope::core::plant {

/// Who is the source, as probabilities that add up to 1.
struct SourceOdds {
  std::vector<double> members;  ///< in the order of the evidence
  double outside = 1.0;         ///< none of them
};

/// Conditional logit (McFadden 1974): every member and "none of them" have a score (log odds),
/// linear in figures_of(), and the odds are the exponentials of the scores. The weights were fitted
/// on simulated plants; others were scored (MEASURED.md).
[[nodiscard]] SourceOdds rank_sources(std::span<const SourceEvidence> evidence);

}  // namespace loopscope::core::plant
