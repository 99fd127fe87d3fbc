#pragma once

namespace loopscope::core::hos {

/// Upper tail of the law of the mean of K bic2 over the triangle: Pearson III with this mean and
/// standard deviation and the skewness that the mean was measured to have.
[[nodiscard]] double mean_law_upper(double value, double mean, double std);

/// Probability that K bic2 of a cell exceeds `evidence` when its expectation is 1 + `level`: 2 K
/// bic2 is noncentral chi-square with two degrees of freedom. `level` >= 0.
[[nodiscard]] double cell_law_upper(double evidence, double level);

/// Probability that the most extreme of `cells` independent ones has this p.
[[nodiscard]] double smallest_of(double p, double cells);

}  // namespace loopscope::core::hos
