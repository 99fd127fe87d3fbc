#pragma once

#include <cstddef>

/// Tails and quantiles of the usual distributions, by Boost.Math. An upper tail is the probability
/// of more than the value, with full relative precision however small it is; below the smallest
/// double it is 0. An argument that is NaN gives NaN, as does one out of its range unless a value
/// is given for that.
namespace loopscope::core::hos {

/// At least the smallest normal double: a p of 0 would call chance impossible and has no logarithm.
[[nodiscard]] double above_zero(double p);

[[nodiscard]] double normal_upper(double deviate);

/// The deviate that is exceeded with `probability`, 1e-300 to 1: 1.6448536... for 0.05.
[[nodiscard]] double normal_upper_quantile(double probability);

/// `freedom` > 0; 1 for a value of 0 and less.
[[nodiscard]] double chi_square_upper(double value, double freedom);

/// Of the gamma distribution of unit scale, `shape` > 0; 1 for a value of 0 and less.
[[nodiscard]] double gamma_upper(double value, double shape);

/// Of Fisher's F, the ratio of two variance estimates of equal expectation with `freedom_1` over
/// `freedom_2` degrees of freedom, both > 0; 1 for a ratio of 0 and less.
[[nodiscard]] double f_upper(double ratio, double freedom_1, double freedom_2);

/// The same ratio as a standard normal deviate: that with the same upper tail, within -37 to 37.
[[nodiscard]] double f_deviate(double ratio, double freedom_1, double freedom_2);

/// `freedom` > 0.
[[nodiscard]] double student_upper(double t, double freedom);

/// Probability of at least `hits` successes in `trials` (>= hits) of `probability` each.
[[nodiscard]] double binomial_at_least(std::size_t hits, std::size_t trials, double probability);

}  // namespace loopscope::core::hos
