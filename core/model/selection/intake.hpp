#pragma once

#include <optional>
#include <vector>

#include "core/model/selection/candidate_fit.hpp"
#include "core/model/selection/stepwise_model.hpp"

namespace loopscope::core::model {

/// What a round's trials are taken in by.
struct IntakeTerms {
  const LoopData& original;                 ///< before any effect placed its rows
  const ResidualTests& tests;               ///< put to what is left once an effect is in
  const std::vector<TestOutcome>& answers;  ///< what they said before
  std::optional<EffectKind> outdone_by = std::nullopt;  ///< SelectionOutcome::outdone_by
  double passed_over = 0.0;                             ///< SelectionOutcome::passed_over
};

/// The first of the trials that enters, explains something further ahead as well (`foresees`) and
/// answers the tests that asked for it becomes a chapter; they come the most probable first.
/// Whether there was one. Nothing enters behind a trial that let others be passed over and is
/// refused.
///
/// A valve's law is a needle, and the search for it is one of chance: a valve that goes between the
/// samples, or that does not foresee what it should, is looked for once more before it is weighed,
/// and again as long as a test that asked for it still speaks with it in the model
/// (refine_valve.hpp).
[[nodiscard]] bool take_in(std::vector<CandidateFit> trials, const IntakeTerms& terms,
                           StepwiseModel& story);

}  // namespace loopscope::core::model
