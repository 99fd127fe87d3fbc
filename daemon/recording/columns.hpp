#pragma once

#include <cstddef>
#include <optional>

#include "daemon/text/csv_table.hpp"

namespace loopscope::daemon {

/// Where the columns of a recording stand in its table.
struct Columns {
  std::size_t time = 0;
  bool absolute_time = false;  ///< the time column is `time` (ISO 8601), not `t_s` (seconds)
  std::size_t pv = 0;
  std::optional<std::size_t> sp, op, mv, mode, quality;
};

/// Names are compared without case and blanks; other columns are ignored. Throws Failure
/// (unusable_data): no time or pv column, or one of these columns twice.
[[nodiscard]] Columns find_columns(const CsvTable& table);

}  // namespace loopscope::daemon
