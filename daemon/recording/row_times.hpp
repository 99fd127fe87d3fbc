#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "daemon/recording/columns.hpp"
#include "daemon/text/csv_table.hpp"
#include "daemon/text/time_zone.hpp"
#include "daemon/text/written_time.hpp"

namespace loopscope::daemon {

/// How the cells of a time column are written.
struct TimeCells {
  char decimal_sign = '.';  ///< of seconds
  std::optional<DateOrder> date_order =
      std::nullopt;  ///< of dates; nullopt = day first where points are between
};

/// The time of every row in microseconds (absolute: UTC since 1970), ascending, within 3e10 s of
/// each other. A time without an offset is meant in `zone`; of an hour that its clock repeats the
/// first, until the rows come to the second. Throws Failure (unusable_data) naming line and column:
/// a cell that is no time, one outside +-9e12 s or the years 1 to 9999, times that run backwards, a
/// longer span; without an order a date whose day and month are told apart by none.
[[nodiscard]] std::vector<std::int64_t> read_times(const CsvTable& table, const Columns& columns,
                                                   const TimeCells& cells = {},
                                                   const TimeZone& zone = {});

}  // namespace loopscope::daemon
