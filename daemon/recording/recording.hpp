#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/signal/assemble.hpp"
#include "core/signal/loop_window.hpp"
#include "daemon/recording/recording_form.hpp"
#include "daemon/text/csv_table.hpp"
#include "daemon/text/time_zone.hpp"

namespace loopscope::daemon {

/// One recorded loop as contract.md describes the file: `t_s` (seconds) or `time` (ISO 8601), pv,
/// and where recorded sp, op, mv, mode, quality; or as spreadsheets and control systems export it
/// (README.md). Other columns are ignored.
struct Recording {
  std::string name;  ///< the file, for messages
  /// The file had `time`: times are microseconds UTC since 1970; else they count from t_s = 0.
  bool absolute_time = false;
  core::signal::LoopRows rows;  ///< empty cells, NaN, infinity and bad quality are NaN
  /// What a reader should know of how the file was understood, a sentence each.
  std::vector<std::string> notes = {};
};

/// Throws Failure (unusable_data) naming line and column: what find_columns(), find_decimal_sign()
/// and read_times() refuse, and text in a number column. Times without an offset are meant in
/// `zone`, as read_times() has it.
[[nodiscard]] Recording parse_recording(const CsvTable& table, const RecordingForm& form = {},
                                        const TimeZone& zone = {});

/// The same of a file's text; `name` stands for it in messages. Throws as parse_csv(), too.
[[nodiscard]] Recording parse_recording(std::string_view text, const std::string& name,
                                        const RecordingForm& form = {}, const TimeZone& zone = {});

/// The same of a file. Throws as read_csv(), too.
[[nodiscard]] Recording read_recording(const std::filesystem::path& file,
                                       const RecordingForm& form = {}, const TimeZone& zone = {});

/// The last `max_samples` samples of the recording, of those up to `end_us` where it is given, on
/// its own grid (the usual spacing of its rows; 1 s where it has none). Size 0 without such rows.
[[nodiscard]] core::signal::LoopWindow last_window(
    const Recording& recording, std::size_t max_samples,
    const std::optional<core::signal::OpRange>& op_range, std::optional<std::int64_t> end_us = {});

}  // namespace loopscope::daemon
