#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/model/fit/trial.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"
#include "core/model/selection/candidate_fit.hpp"

namespace loopscope::core::model {

/// A fit as it was judged on rows that it had not seen.
struct Judged {
  CrossFit fit;
  Rows rows;
  bool once = false;  ///< on the score rows alone (candidate_fit.hpp), else on those of both kinds
};

/// An effect that was taken in.
struct SelectedEffect {
  CrossFit fit;                 ///< with it and all before it
  Comparison comparison;        ///< with it against without it
  double rival_evidence = 0.0;  ///< of the best effect of another cause in the same round; of such
                                ///< as were not tried, their promise
  double simulation_ratio = 1.0;
  std::size_t promise_rank = 0;        ///< among what the residual tests asked for; 0 = nobody did
  std::vector<TestOutcome> asked_for;  ///< of the residual tests, before it and after it
  std::vector<TestOutcome> left;
  /// Of the effect.
  [[nodiscard]] EffectKind kind() const { return fit.fit.structure.effects.back()->kind(); }
  Judged judged;  ///< what `comparison` has after it, before the process was settled behind it
};

/// From the linear loop to the last effect that the data ask for.
struct StepwiseModel {
  LoopData data;  ///< with the rows on which the last fit is judged
  CrossFit baseline;
  std::vector<SelectedEffect> selected;
  Rows first_rows = data.rows;  ///< on which the baseline is judged
  [[nodiscard]] const CrossFit& last() const {
    return selected.empty() ? baseline : selected.back().fit;
  }
};

/// Fits the linear loop.
[[nodiscard]] StepwiseModel start_selection(const LoopData& data);

/// What the residual tests say of a fit of the record.
using ResidualTests = std::function<std::vector<TestOutcome>(const LoopData&, const Fit&)>;

/// Takes in one effect after the other, six at most, each time the one least probable by chance, as
/// long as that is significant. The residual tests lead: what they ask for is tried, and what
/// nobody asked for gets a cheap look once nothing else enters. `answers` to the linear loop's
/// residual; returns those to the last one's.
[[nodiscard]] std::vector<TestOutcome> select_effects(StepwiseModel& stepwise,
                                                      std::vector<TestOutcome> answers,
                                                      const ResidualTests& tests);

/// A valve that has entered, but that the tests which asked for it still see: the narrow minimum of
/// its law was missed (stiction_search.hpp). It is looked for again between the samples, behind the
/// process of `settled`, which it showed well enough for the right one to show. One that acts at
/// the samples is looked for by either law, between them the two move so differently that the one
/// which leads is right.
///
/// `settled` ends with that valve; each `attempt` has first guesses of its own. nullopt where
/// nothing is found that is worth more.
[[nodiscard]] std::optional<CandidateFit> refine_valve(const CandidateFit& entered,
                                                       const Fit& settled, std::size_t attempt);

/// What a round's trials are taken in by.
struct IntakeTerms {
  const LoopData& original;                 ///< before any effect placed its rows
  const ResidualTests& tests;               ///< put to what is left once an effect is in
  const std::vector<TestOutcome>& answers;  ///< what they said before
  std::optional<EffectKind> outdone_by = std::nullopt;  ///< SelectionOutcome::outdone_by
  double passed_over = 0.0;                             ///< SelectionOutcome::passed_over
};

/// The first of the trials that enters, explains something further ahead as well (`foresees`) and
/// answers the tests that asked for it becomes a selected effect; they come the most probable
/// first. Whether there was one. Nothing enters behind a trial that let others be passed over and
/// is refused.
///
/// A valve's law has a narrow minimum, and the search for it is random: a valve that acts between
/// the samples, or that does not foresee what it should, is looked for once more before it is
/// weighed, and again as long as a test that asked for it still speaks with it in the model
/// (refine_valve()).
[[nodiscard]] bool take_in(std::vector<CandidateFit> trials, const IntakeTerms& terms,
                           StepwiseModel& stepwise);

}  // namespace loopscope::core::model
