#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "core/model/fit/fit.hpp"
#include "core/model/fit/trial.hpp"

namespace loopscope::core::model {

/// The structure with its effects, everything fitted anew: effect, delay, poles, noise. A valve
/// that leaves more than `hopeless` (a fit_error) once the process has been searched behind it is
/// returned as it is then: the search for its band and jump is the costly part.
[[nodiscard]] Fit fit_candidate(const LoopData& data, Fit fit,
                                double hopeless = std::numeric_limits<double>::infinity());

/// How much better one fit predicts several rows ahead than another, on the held-out rows: n / h
/// ln(before / after) of the mean squares of the error h rows ahead, of which n / h are apart.
///
/// That error is e(k) = sum over j < h of psi(j) w(k - j), psi the impulse response of the noise
/// model and w the one-step errors (Box and Jenkins, 5.1: the error of a forecast with lead h),
/// with op known. h is 10, with fewer than 2000 rows a 200th of them, 3 at least.
///
/// What obeys a law of op is foreseen at every distance, and better the farther. What imitates a
/// disturbance that the model lacks is bought with another process and a noise that keeps its
/// errors: one row ahead it gains, ten ahead it loses.
[[nodiscard]] double multi_step_evidence(const LoopData& rows, const Fit& before, const Fit& after);

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

/// Whether an effect within the loop is significant (p <= kEnters) several rows ahead as well
/// (multi_step_evidence()); true of what comes from outside, which op does not foretell.
[[nodiscard]] bool foresees(const CandidateFit& trial);

/// Whether what it explains beyond each plainer effect that leaves part of the same mark
/// (Effect::plainer) is significant by itself, at the price of its search.
[[nodiscard]] bool refutes_plainer(const CandidateFit& trial);

/// Fits the other fold of one that is taken in.
void complete(CandidateFit& winner);

}  // namespace loopscope::core::model
