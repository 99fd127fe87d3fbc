#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "nonlinear" and "ngi": the calibrated tests of core/hos on the residual, all of them combined,
/// and the mean bicoherence alone (skewed white noise has one too). They nominate nothing. Empty
/// with fewer than kFewestAsked samples, or when gaps leave fewer than two segments. `innovation`:
/// any unit, NaN = missing; `seed` as in hos::analyse.
[[nodiscard]] std::vector<TestOutcome> test_coupling(std::span<const double> innovation,
                                                     std::uint64_t seed);

}  // namespace loopscope::core::model
