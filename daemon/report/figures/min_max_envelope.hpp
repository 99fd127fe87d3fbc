#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::daemon {

/// A picture of the report has about as many columns.
inline constexpr std::size_t kPictureColumns = 330;

/// One point of a curve; y NaN = the curve is broken here.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// A series thinned to what a picture `columns` columns wide can show: of each column the lowest
/// and the highest sample, in the order in which they were recorded, so that no spike and no swing
/// is lost. Sample k lies at start + k * step. A column without any sample breaks the curve; a
/// series of at most 2 `columns` (> 0) samples is kept whole.
[[nodiscard]] std::vector<Point> envelope(std::span<const double> samples, double start,
                                          double step, std::size_t columns);

}  // namespace loopscope::daemon
