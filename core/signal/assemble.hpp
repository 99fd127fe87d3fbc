#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/signal/grid.hpp"
#include "core/signal/loop_window.hpp"
#include "core/signal/raw_series.hpp"

namespace loopscope::core::signal {

/// The rows of all tags of one loop. `mode` carries ControlMode as a number (0 manual,
/// 1 automatic, 2 cascade, anything else unknown); tags that are not recorded are empty.
struct LoopRows {
  RawSeries sp, pv, op, mv, mode;
};

/// The grid of a window that ends at `end_us` or less than one interval before it, on the phase of
/// pv's newest row not after `end_us`, or of its usual row where the stamps jitter (then it may end
/// up to half an interval behind `end_us`); at most `max_samples` slots, none before pv's first
/// row. Size 0 when pv has no row up to `end_us`. `sample_interval_s` > 0.
[[nodiscard]] Grid window_grid(const RawSeries& pv, double sample_interval_s, std::int64_t end_us,
                               std::size_t max_samples);

/// Rows of several tags onto one grid: pv, op and mv as their archives keep them (RawSeries::hold),
/// setpoint and mode always held from change to change. A tag without rows stays empty.
[[nodiscard]] LoopWindow assemble(const LoopRows& rows, const Grid& grid,
                                  const std::optional<OpRange>& op_range);

}  // namespace loopscope::core::signal
