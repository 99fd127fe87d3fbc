#pragma once

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "white": is the residual linked with its own past? The portmanteau of Ljung and Box (1978) with
/// each autocorrelation over its own standard error (Lo and MacKinlay 1989), which neither missing
/// samples nor a variance that comes and goes disturb, of values brought in to two standard
/// deviations:
///
///     Q = sum over j of (sum r(k) r(k-j))^2 / sum r(k)^2 r(k-j)^2 ~ chi-square, lags 1 to 25
///
/// It nominates nothing: what is missing is the other questions' to say.
[[nodiscard]] TestOutcome test_white(const ResidualContext& context);

}  // namespace loopscope::core::model
