#pragma once

#include <optional>

#include "core/model/record/loop_data.hpp"
#include "core/model/results/explanation.hpp"
#include "core/model/selection/stepwise_model.hpp"

namespace loopscope::core::model {

/// Fits a loop model to the recording, finds what it lacks, adds it, and says what is left.
///
/// nullopt when there is nothing to fit: op not recorded, pv or op constant, infinite or beyond
/// 1e70, fewer than 400 samples on which both are known, or fewer than 100 rows to fit or to score.
/// Series of different lengths throw std::invalid_argument.
///
/// - The linear loop (baseline.hpp): one or two lags or an integrator, at least one sample of
///   delay, numerator, noise with real poles; order by BIC.
/// - Effects enter one after the other, the one with most evidence first, while the split
///   likelihood ratio on unseen rows stays below p = 0.001 (stepwise_model.hpp).
/// - `unexplained.fraction` is (error - floor) / (baseline error - floor), 0 to 1: of what could be
///   explained, the share that is not. Where the baseline lies within 2 % of the floor, 2 % of it
///   is taken for what could be explained. Where the errors are simulation errors no floor is known
///   (NaN), and the fraction is what the valve leaves of the linear error: an upper bound.
[[nodiscard]] std::optional<Explanation> explain(const ModelInput& input);

/// An explanation with the fits that it was read off.
struct FittedLoop {
  Explanation explanation;
  /// Every sample a row. Without selected effects where `renewals` has them.
  StepwiseModel samples;
  /// Of a held sensor that is renewed often enough: the same on the rows of its renewals.
  std::optional<StepwiseModel> renewals;
};

/// explain() with the fits behind it.
[[nodiscard]] std::optional<FittedLoop> fit_loop_model(const ModelInput& input);

}  // namespace loopscope::core::model
