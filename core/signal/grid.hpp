#pragma once

#include <cstddef>
#include <cstdint>

#include "core/signal/loop_window.hpp"
#include "core/signal/raw_series.hpp"

namespace loopscope::core::signal {

/// to_us - from_us without overflow: two times may lie further apart than their type can say.
[[nodiscard]] double elapsed_us(std::int64_t from_us, std::int64_t to_us);

/// time_us moved by `offset_us` (at most 2^64 either way), rounded to whole microseconds; the
/// earliest or latest time that the type can say where the sum lies beyond.
[[nodiscard]] std::int64_t moved_us(std::int64_t time_us, double offset_us);

/// A uniform grid of sample times.
struct Grid {
  std::int64_t start_us = 0;       ///< first slot, microseconds UTC since 1970
  double sample_interval_s = 1.0;  ///< > 0
  std::size_t size = 0;

  /// Time of slot k, microseconds.
  [[nodiscard]] std::int64_t time_us(std::size_t k) const;
};

/// Rows onto the grid: slots without a value are NaN. With Hold::step and Hold::linear a bad row
/// (NaN) ends what the row before it began; with Hold::linear nothing is known behind the last row.
/// Where several rows fall into one slot the last one counts.
[[nodiscard]] Samples align(const RawSeries& rows, const Grid& grid, Hold hold);

/// Number of rows whose time equals that of the row before.
[[nodiscard]] std::size_t count_repeated_times(const RawSeries& rows);

/// The median spacing of the rows in seconds (gaps and jitter do not move it); 0 when no two rows
/// differ in time.
[[nodiscard]] double usual_interval_s(const RawSeries& rows);

}  // namespace loopscope::core::signal
