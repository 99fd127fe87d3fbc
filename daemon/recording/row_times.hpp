#pragma once

#include <cstdint>
#include <vector>

#include "daemon/recording/columns.hpp"
#include "daemon/text/csv_table.hpp"

namespace loopscope::daemon {

/// The time of every row in microseconds (absolute: UTC since 1970), ascending, within 3e10 s of
/// each other. Throws Failure (unusable_data) naming line and column: a cell that is no time, one
/// outside +-9e12 s or the years 1 to 9999, times that run backwards, a longer span.
[[nodiscard]] std::vector<std::int64_t> read_times(const CsvTable& table, const Columns& columns);

}  // namespace loopscope::daemon
