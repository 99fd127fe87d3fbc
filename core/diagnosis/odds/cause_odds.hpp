#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {

/// What one figure adds to the log odds of a cause, or the other causes together, or any
/// nonlinearity of valve and process.
struct Part {
  std::optional<std::size_t> figure;  ///< place in all_figures(); nullopt = of the others
  std::optional<double> value;        ///< nullopt = not computed; of others the probability of any
  double weight = 0.0;                ///< log odds; above 0 it speaks for the cause
  /// The most probable of the others; nonlinear_unexplained = any nonlinearity.
  VerdictCode other = VerdictCode::healthy;
};

/// A cause and what speaks for it. Causes may stand together: their probabilities need not add up.
struct WeighedCause {
  VerdictCode code = VerdictCode::healthy;
  double log_odds = 0.0;
  double prior = 0.0;       ///< probability, 0 to 1, before anything is measured: settings or fit
  std::vector<Part> parts;  ///< the weightiest first
  double evidence = 0.0;    ///< log odds beyond the prior by its own figures, whatever the others
  [[nodiscard]] double probability() const;
};

using Causes = std::vector<WeighedCause>;

/// 0 where the cause was not weighed.
[[nodiscard]] double probability_in(const Causes& causes, VerdictCode code);

/// @throws std::invalid_argument a probability is not from 0 to 1, or a prior is 1
void check(const DecisionSettings& settings);

/// Probability of each cause: what the settings say, else its share in the fit.
[[nodiscard]] PerCause priors_of(const DecisionSettings& settings);

/// Every cause of the fitted tables, the most probable first. By the curves for loops with a model
/// where one was fitted.
[[nodiscard]] Causes weigh_causes(const Evidence& evidence, const DecisionSettings& settings = {});

/// The same without valve and controller where op says nothing: nothing is known of them then.
[[nodiscard]] Causes known_causes(const Evidence& evidence, const DecisionSettings& decision);

}  // namespace loopscope::core::diagnosis
