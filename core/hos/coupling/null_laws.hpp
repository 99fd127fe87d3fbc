#pragma once

namespace loopscope::core::hos {

/// exp(-evidence), the p of a statistic (>= 0) that is exponential with mean 1 under its null. Like
/// every tail here at least the smallest normal number, 2.2e-308: a p of 0 would call chance
/// impossible and has no logarithm.
[[nodiscard]] double p_of_evidence(double evidence);

/// Upper tail of the law of the mean of K bic2 over the triangle: Pearson III with this mean and
/// standard deviation (both > 0) and the skewness that the mean was measured to have, 2.9 std /
/// mean.
[[nodiscard]] double mean_law_upper(double value, double mean, double std);

/// Probability that K bic2 of a cell exceeds `evidence` when its expectation is 1 + `level`: 2 K
/// bic2 is noncentral chi-square with two degrees of freedom. `level` >= 0.
[[nodiscard]] double cell_law_upper(double evidence, double level);

/// Probability that the smallest of `cells` (>= 1) independent p-values is `p` or less: 1 - (1 -
/// p)^cells.
[[nodiscard]] double smallest_of(double p, double cells);

}  // namespace loopscope::core::hos
