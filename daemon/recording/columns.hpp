#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/recording/recording_form.hpp"
#include "daemon/text/csv_table.hpp"

namespace loopscope::daemon {

/// Where the columns of a recording stand in its table.
struct Columns {
  std::size_t time = 0;
  bool absolute_time = false;  ///< the time column holds dates and clocks, not seconds
  std::size_t pv = 0;
  std::optional<std::size_t> sp, op, mv, mode, quality;
  /// Found by other names than those of contract.md.
  bool by_other_names = false;
};

/// Names are compared without case and blanks: those that `form` says, then t_s, time, pv, sp, op,
/// mv, mode and quality; where these give no time or no pv, or `form` says any, other spellings too
/// (read_column_name()). Other columns are ignored. Throws Failure (unusable_data): no time or pv
/// column, one of these columns twice, no column of a name that `form` says.
[[nodiscard]] Columns find_columns(const CsvTable& table, const RecordingForm& form = {});

/// Whether a header has what find_columns() needs.
[[nodiscard]] bool is_header_of_recording(const std::vector<std::string>& header,
                                          const RecordingForm& form);

/// What a reader should know of how the columns were taken, a sentence each: which were found by
/// other names, which look like one and were not read; empty where nothing is odd.
[[nodiscard]] std::vector<std::string> column_notes(const CsvTable& table, const Columns& columns);

}  // namespace loopscope::daemon
