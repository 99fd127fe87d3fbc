#pragma once

#include <optional>
#include <span>

namespace loopscope::core::loop {

/// Figures of wave shape and of the pv-op and mv-op plots; nullopt = cannot be computed.
struct Shape {
  /// Horch's cross-correlation of op and pv around lag 0: |tl - tr| / (tl + tr), 0 to 1.
  /// Above 2/3 (odd) speaks for stiction in a self-regulating loop under PI control.
  std::optional<double> horch_dtau;
  /// ||r0| - max|r|| / (|r0| + max|r|), 0 to 1; above 1/3 (odd) speaks for stiction.
  std::optional<double> horch_drho;
  /// He, Wang, Pottmann and Qin: MSE_sine / (MSE_sine + MSE_triangle) of the half cycles;
  /// >= 0.6 triangular (stiction), <= 0.4 sinusoidal.
  std::optional<double> shape_index;
  /// Extent in op, at the mean of pv, of the ellipse fitted to the lag-compensated pv-op plot, % of
  /// the span that op covers while it oscillates; 0 to 100.
  std::optional<double> ellipse_stiction;
  /// Quality of that ellipse, 0 to 1; below 0.5 the figure is inconclusive.
  std::optional<double> ellipse_r2;
  /// Mean width in op of the mv-op hysteresis at the same mv, % of op range (needs mv): the dead
  /// band, or stickband less slip jump.
  std::optional<double> mv_op_width;
  /// Mean jump of mv, beyond op's own move, when it leaves rest, % of op range (needs mv): the
  /// slip jump J of a sticking valve, 0 for a dead band.
  std::optional<double> mv_slip_jump;
  /// Share of the samples with op moving in which mv stands still (needs mv), 0 to 1.
  std::optional<double> mv_stuck_fraction;
};

/// What the shape figures are read from. Spans may hold NaN; op, mv empty = not recorded.
struct ShapeInput {
  std::span<const double> error;         ///< sp - pv, pv units
  std::span<const double> pv;            ///< pv units
  std::span<const double> op_percent;    ///< % of op range
  std::span<const double> mv_percent;    ///< % of op range
  std::optional<double> period_samples;  ///< of the oscillation; nullopt = none found
  bool integrating = false;              ///< level loop: the shape is read from pv, else from op
};

/// The mv figures need op and mv only; all others a period (2 samples to half of the record), and
/// op and pv of one length that vary.
[[nodiscard]] Shape measure_shape(const ShapeInput& input);

}  // namespace loopscope::core::loop
