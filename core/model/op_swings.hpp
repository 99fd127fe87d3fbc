#pragma once

#include <span>

namespace loopscope::core::model {

/// Samples of a full cycle of op, counting only turns after which op moves by more than
/// `swing_percent`: twice the length over the number of such turns; infinite when there is none.
/// op without NaN.
[[nodiscard]] double swing_period(std::span<const double> op, double swing_percent);

}  // namespace loopscope::core::model
