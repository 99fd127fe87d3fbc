#pragma once

#include <optional>
#include <vector>

#include "core/model/selection/candidate_fit.hpp"
#include "core/model/selection/effect_screening.hpp"

namespace loopscope::core::model {

/// A kind of effect that a round looks for.
struct SoughtKind {
  EffectKind kind = EffectKind::load_step;
  double promise = 0.0;  ///< evidence: Nominations::promise, or what the best first look gains
  std::vector<Candidate> looked_at;
};

/// What a round may try. `round` has to outlive it.
class CandidateSearch {
 public:
  explicit CandidateSearch(const Round& round);

  /// What promises most is first; the valve's two kinds go under one.
  [[nodiscard]] const std::vector<SoughtKind>& kinds() const { return kinds_; }
  /// The best of a kind, of a valve and of a bend the best of each law, and all load steps.
  [[nodiscard]] std::vector<Candidate> worth_fitting(const SoughtKind& sought) const;

 private:
  [[nodiscard]] SoughtKind look_at(EffectKind kind);

  const Round& round_;
  EffectScreening looks_;
  std::vector<SoughtKind> kinds_;
  double best_look_ = 0.0;  ///< of all kinds, n ln
};

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
