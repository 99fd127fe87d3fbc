#pragma once

#include "core/model/fit.hpp"

namespace loopscope::core::model {

/// The rows away from gross one-step errors (six standard deviations, robustly measured): a load
/// that jumps would bend the first fit of the process, by which everything after it is judged.
[[nodiscard]] Rows calm_rows(const Rows& rows, const Fit& fit);

}  // namespace loopscope::core::model
