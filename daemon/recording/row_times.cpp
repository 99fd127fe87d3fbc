#include "daemon/recording/row_times.hpp"

#include <cmath>
#include <fmt/format.h>
#include <string>

#include "core/signal/loop_window.hpp"
#include "core/signal/microseconds.hpp"
#include "daemon/text/cell_failure.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

/// Beyond this many seconds (about 285 000 years) microseconds do not fit into 64 bits.
constexpr double kLargestTime_s = 9e12;
/// About 950 years: no recording is that long, so a time in it is in another unit or damaged.
constexpr double kLongestSpan_s = 3e10;

std::int64_t seconds_cell(const CsvTable& table, const CsvTable::Row& row, std::size_t column) {
  const double seconds = parse_number(row.cells[column]).value_or(core::signal::kMissing);
  if (std::abs(seconds) <= kLargestTime_s) return core::signal::microseconds(seconds);
  throw cell_failure(table, row, column, shown(row.cells[column]) + " is not a time",
                     "every row needs its time in seconds, within +-9e12");
}

std::int64_t iso_cell(const CsvTable& table, const CsvTable::Row& row, std::size_t column) {
  if (const auto time = parse_time(trimmed(row.cells[column]))) return *time;
  throw cell_failure(table, row, column, shown(row.cells[column]) + " is not a time",
                     "write ISO 8601 in the years 1 to 9999, e.g. 2026-03-01T12:00:00Z");
}

void require_ascending(const CsvTable& table, const CsvTable::Row& row, const Columns& columns,
                       std::int64_t before_us, std::int64_t now_us) {
  if (now_us >= before_us) return;
  const std::string& cell = row.cells[columns.time];
  const bool local = columns.absolute_time && !names_zone(trimmed(cell));
  throw cell_failure(table, row, columns.time,
                     fmt::format("the time {} runs backwards", shown(cell)),
                     local ? "write the times in UTC or with their offset; local time repeats an "
                             "hour when daylight saving ends"
                           : "sort the rows by time");
}

void require_short_span(const CsvTable& table, const CsvTable::Row& row, const Columns& columns,
                        std::int64_t first_us, std::int64_t now_us) {
  // The difference in 64 bits could overflow; doubles are exact enough for this limit.
  const double span_us = static_cast<double>(now_us) - static_cast<double>(first_us);
  if (span_us <= kLongestSpan_s * core::signal::kMicrosecondsPerSecond) return;
  throw cell_failure(table, row, columns.time,
                     fmt::format("the time {} lies more than 3e10 s (950 years) after the first",
                                 shown(row.cells[columns.time])),
                     columns.absolute_time ? "check the years of the times"
                                           : "check the times: t_s counts seconds");
}

}  // namespace

std::vector<std::int64_t> read_times(const CsvTable& table, const Columns& columns) {
  std::vector<std::int64_t> times;
  times.reserve(table.rows.size());
  for (const CsvTable::Row& row : table.rows) {
    const std::int64_t now_us = columns.absolute_time ? iso_cell(table, row, columns.time)
                                                      : seconds_cell(table, row, columns.time);
    if (!times.empty()) {
      require_ascending(table, row, columns, times.back(), now_us);
      require_short_span(table, row, columns, times.front(), now_us);
    }
    times.push_back(now_us);
  }
  return times;
}

}  // namespace loopscope::daemon
