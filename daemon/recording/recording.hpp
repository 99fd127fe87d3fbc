#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/signal/assemble.hpp"
#include "core/signal/loop_window.hpp"
#include "daemon/text/csv_table.hpp"
#include "daemon/text/time_zone.hpp"

namespace loopscope::daemon {

/// One recorded loop as contract.md describes the file: `t_s` (seconds) or `time` (ISO 8601), pv,
/// and where recorded sp, op, mv, mode, quality. Other columns are ignored.
struct Recording {
  std::string name;  ///< the file, for messages
  /// The file had `time`: times are microseconds UTC since 1970; else they count from t_s = 0.
  bool absolute_time = false;
  core::signal::LoopRows rows;  ///< empty cells, NaN, infinity and bad quality are NaN
};

/// Times without an offset are meant in `zone`, as read_times() has it.
/// Throws Failure (unusable_data) naming line and column: what find_columns() and read_times()
/// refuse, and text in a number column.
[[nodiscard]] Recording parse_recording(const CsvTable& table, const TimeZone& zone = {});

/// parse_recording(read_csv(file)). Throws as both.
[[nodiscard]] Recording read_recording(const std::filesystem::path& file,
                                       const TimeZone& zone = {});

/// The last `max_samples` samples of the recording, of those up to `end_us` where it is given, on
/// its own grid (the usual spacing of its rows; 1 s where it has none). Size 0 without such rows.
[[nodiscard]] core::signal::LoopWindow last_window(
    const Recording& recording, std::size_t max_samples,
    const std::optional<core::signal::OpRange>& op_range, std::optional<std::int64_t> end_us = {});

}  // namespace loopscope::daemon
