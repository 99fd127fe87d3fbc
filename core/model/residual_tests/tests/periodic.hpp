#pragma once

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "periodic": are there lines in the spectrum of the residual, or of pv (spectral_lines.hpp)? The
/// baseline absorbs an outside sinusoid in part, so pv is asked too. Nominates external_oscillation
/// for up to three lines. A limit cycle of the loop itself shows as a line of pv as well.
[[nodiscard]] TestOutcome test_periodic(const ResidualContext& context);

}  // namespace loopscope::core::model
