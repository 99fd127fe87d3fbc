#pragma once

#include <optional>

#include "core/hos/coupling/harmonic_test.hpp"
#include "core/hos/coupling/quadratic_test.hpp"

namespace loopscope::core::hos {

/// First-pass p of quadratic coupling somewhere: in one cell of the triangle, or of the oscillation
/// with its second harmonic on segments that fit it, which the triangle's short segments cannot
/// hold when it is slow.
[[nodiscard]] double nli_p(const QuadraticTest& test, const QuadraticStatistics& found,
                           const std::optional<HarmonicStatistics>& harmonics);

}  // namespace loopscope::core::hos
