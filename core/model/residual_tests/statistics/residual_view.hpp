#pragma once

#include <span>

namespace loopscope::core::model {

/// What a fitted loop model leaves, beside what it was fitted to. All spans have one length; NaN is
/// a missing sample. A span of the right length full of NaN stands for a signal that nobody has.
struct ResidualView {
  /// r(k) = pv(k) - its one-step prediction, pv units; white when the model is right.
  std::span<const double> innovation;
  std::span<const double> op_percent;
  /// Sign of op's last motion beyond its noise, known at k: +1 or -1; 0 = it has not moved yet.
  std::span<const double> op_direction;
  /// x(k): the deterministic output of the model, driven by op before k, pv units.
  std::span<const double> response;
  std::span<const double> pv;
  double sample_interval_s = 1.0;  ///< > 0
  /// pv less the waves and loads that the model has; empty = it has none.
  std::span<const double> pv_undisturbed{};
};

}  // namespace loopscope::core::model
