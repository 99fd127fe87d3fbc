#pragma once

#include <optional>
#include <vector>

#include "core/model/selection/candidate_fit.hpp"
#include "core/model/selection/round.hpp"

namespace loopscope::core::model {

struct SelectionOutcome {
  /// The best of every kind that has anything to show, the least probable by chance first. What is
  /// scored once has no fit to the other fold yet.
  std::vector<CandidateFit> trials;
  /// The kind whose trial let others be passed over, where any were, and the most that one of them
  /// promised. Where that trial is refused, they have to be tried.
  std::optional<EffectKind> outdone_by;
  double passed_over = 0.0;
};

/// Tries what promises most first.
[[nodiscard]] SelectionOutcome run_selection_round(const Round& round);

}  // namespace loopscope::core::model
