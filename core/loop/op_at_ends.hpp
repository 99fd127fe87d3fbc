#pragma once

#include <optional>
#include <span>

namespace loopscope::core::loop {

/// Where op rests at an end of what it covers in the record: at a limit of the controller or of the
/// valve, or only where its cycle turns. An end counts only if op is there for much longer
/// than at the nearest value further in: an op that is coarse, or held for some samples, stays at
/// every value.
struct OpAtEnds {
  /// Of the samples, 0 to 1, in runs of at least three within a thousandth of the span of an end
  /// that op comes back to: a single one is no limit.
  double share = 0.0;
  double visits = 0.0;  ///< rests at the busier end
};

/// `op` in any unit, NaN = missing; nullopt where fewer than 32 samples are recorded or op has
/// fewer than five values: nothing can be told then.
[[nodiscard]] std::optional<OpAtEnds> measure_op_at_ends(std::span<const double> op);

}  // namespace loopscope::core::loop
