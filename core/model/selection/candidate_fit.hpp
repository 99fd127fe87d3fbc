#pragma once

#include <cstddef>

#include "core/model/fit/trial.hpp"

namespace loopscope::core::model {

/// The p at which an effect enters: one healthy loop in a thousand and kind of effect.
inline constexpr double kEnters = 1e-3;

/// One effect fitted in full, and what it is worth on rows that its fit has not seen.
struct CandidateFit {
  CrossFit fit;
  Comparison comparison;  ///< against `before`; p counts the tries of the search
  LoopData rows;
  CrossFit
      before;  ///< without the effect: the model as it stood, or polished anew if that is better
  double price = 0.0;  ///< 2 ln(tries of the search): what p counts, in units of evidence
  [[nodiscard]] double worth() const { return comparison.evidence - price; }
  [[nodiscard]] bool enters() const { return comparison.p <= kEnters; }
  [[nodiscard]] const Effect& effect() const { return *fit.fit.structure.effects.back(); }
  [[nodiscard]] EffectKind kind() const { return effect().kind(); }
  /// What it gains is counted once: where a step sits was taken from the fit rows, so that the
  /// fit to the other fold has nothing unseen to be scored on.
  [[nodiscard]] bool scored_once() const;
};

/// `trial`, whose rows and model without the effect stand, with that fit of its last effect: scored
/// and priced. `tries`: places, shapes or starting points that the effect was chosen from; of a
/// valve they follow from what was fitted. What is scored once has no fit to the other fold yet.
[[nodiscard]] CandidateFit scored(CandidateFit trial, Fit fit, std::size_t tries);

/// Whether an effect within the loop is significant several rows ahead as well
/// (multi_step_error.hpp); true of what comes from outside, which op does not foretell.
[[nodiscard]] bool foresees(const CandidateFit& trial);

/// Whether what it explains beyond each plainer effect that leaves part of the same mark
/// (Effect::plainer) is significant by itself, at the price of its search.
[[nodiscard]] bool refutes_plainer(const CandidateFit& trial);

/// Fits the other fold of one that is taken in.
void complete(CandidateFit& winner);

}  // namespace loopscope::core::model
