#pragma once

#include <optional>
#include <span>

namespace loopscope::core::loop {

/// How much the valve is asked to move and how far pv goes: an oversized valve (paper, section
/// 6.2.1) shows large pv swings for op moves of a fraction of a percent.
struct ValveGain {
  /// Distance between the 1st and 99th percentile of op, % of its range.
  std::optional<double> op_span_percent;
  /// The same distance of pv, as a share of the mean absolute pv.
  std::optional<double> pv_relative_span;
  /// The same distance, % of the transmitter's range; nullopt where that is not known.
  std::optional<double> pv_span_percent;
};

/// Spans may hold NaN; a figure of an empty or unrecorded series is nullopt.
/// `pv_range`: width of the transmitter's range, pv units, > 0.
[[nodiscard]] ValveGain measure_valve_gain(std::span<const double> pv,
                                           std::span<const double> op_percent,
                                           std::optional<double> pv_range = std::nullopt);

}  // namespace loopscope::core::loop
