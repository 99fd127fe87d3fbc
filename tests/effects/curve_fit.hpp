#pragma once

#include <vector>

#include "tests/effects/scenario.hpp"

namespace loopscope::tests::effects {

/// Between the 2nd and the 98th percentile.
[[nodiscard]] double travel(const std::vector<double>& positions);

/// The c of y = a (x - m + c (x - m)^2 / 50) + b, m = mean of x, that comes nearest to `curve` over
/// the positions (least squares): a bend as the effects of the catalogue describe it, about the
/// operating point of the record.
[[nodiscard]] double centred_curvature(const Curve& curve, const std::vector<double>& positions);

/// Largest by smallest slope of `curve` over the travel of the positions, >= 1.
[[nodiscard]] double gain_ratio(const Curve& curve, const std::vector<double>& positions);

}  // namespace loopscope::tests::effects
