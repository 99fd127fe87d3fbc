#include "daemon/recording/row_times.hpp"

#include <cmath>
#include <fmt/format.h>
#include <string>

#include "core/signal/loop_window.hpp"
#include "core/signal/microseconds.hpp"
#include "daemon/text/cell_failure.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/read_time.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::daemon {
namespace {

/// Beyond this many seconds (about 285 000 years) microseconds do not fit into 64 bits.
constexpr double kLargestTime_s = 9e12;
/// About 950 years: no recording is that long, so a time in it is in another unit or damaged.
constexpr double kLongestSpan_s = 3e10;

std::int64_t seconds_cell(const CsvTable& table, const CsvTable::Row& row, std::size_t column,
                          char decimal_sign) {
  const double seconds =
      parse_number(row.cells[column], decimal_sign).value_or(core::signal::kMissing);
  if (std::abs(seconds) <= kLargestTime_s) return core::signal::microseconds(seconds);
  throw cell_failure(table, row, column, shown(row.cells[column]) + " is not a time",
                     "every row needs its time in seconds, within +-9e12");
}

/// The second pass through an hour that the clock repeats begins where the rows would run
/// backwards.
std::optional<std::int64_t> repeated_time(const WrittenTime& written, const TimeZone& zone,
                                          std::int64_t before_us) {
  if (written.offset_us) return std::nullopt;
  const TimeZone::Moments moments = zone.moments_of(written.clock_us);
  if (moments.times_us.size() < 2) return std::nullopt;
  return moments.times_us.front() >= before_us ? moments.times_us.front() : moments.times_us.back();
}

/// ISO 8601, or as spreadsheets write it; nullopt = neither. Throws for a date whose day and month
/// cannot be told apart.
std::optional<WrittenTime> written_time(const CsvTable& table, const CsvTable::Row& row,
                                        std::size_t column, const std::optional<DateOrder>& order) {
  const std::string_view text = trimmed(row.cells[column]);
  if (const auto time = parse_time(text)) return time;
  if (date_form(text) == DateForm::ambiguous && !order) {
    throw cell_failure(table, row, column,
                       "of the date " + shown(text) + " day and month cannot be told apart",
                       "say which comes first: --date-order dmy, or mdy as in the United States");
  }
  return parse_time(text, order.value_or(DateOrder::day_first));
}

std::int64_t date_cell(const CsvTable& table, const CsvTable::Row& row, std::size_t column,
                       const std::optional<DateOrder>& order, const TimeZone& zone,
                       std::int64_t before_us) {
  const std::string_view text = trimmed(row.cells[column]);
  const auto written = written_time(table, row, column, order);
  const auto read = read_time(written, zone);
  if (const auto* time_us = std::get_if<std::int64_t>(&read)) return *time_us;
  if (const auto time_us = written ? repeated_time(*written, zone, before_us) : std::nullopt)
    return *time_us;
  const auto& problem = std::get<TimeProblem>(read);
  const bool counts = !written && !text.empty() && parse_number(text);
  throw cell_failure(
      table, row, column, shown(row.cells[column]) + " " + problem.what,
      problem.hint + (counts ? "; where the column counts seconds: --columns t_s=NAME" : ""));
}

/// UTC is what a time without an offset is taken for where nobody has named a zone.
bool may_be_local(std::string_view cell, const TimeZone& zone) {
  const auto written = parse_time(cell);
  return zone.is_utc() && written && !written->offset_us;
}

void require_ascending(const CsvTable& table, const CsvTable::Row& row, const Columns& columns,
                       const TimeZone& zone, std::int64_t before_us, std::int64_t now_us) {
  if (now_us >= before_us) return;
  const std::string& cell = row.cells[columns.time];
  const bool local = columns.absolute_time && may_be_local(trimmed(cell), zone);
  throw cell_failure(table, row, columns.time,
                     fmt::format("the time {} runs backwards", shown(cell)),
                     local ? "write the times in UTC or with their offset, or name their zone "
                             "(/plant/time_zone, or --time-zone of analyze); local time repeats an "
                             "hour when daylight saving "
                             "ends"
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

std::vector<std::int64_t> read_times(const CsvTable& table, const Columns& columns,
                                     const TimeCells& cells, const TimeZone& zone) {
  std::vector<std::int64_t> times;
  times.reserve(table.rows.size());
  for (const CsvTable::Row& row : table.rows) {
    const std::int64_t before_us = times.empty() ? storage::kEarliestTimeUs : times.back();
    const std::int64_t now_us =
        columns.absolute_time
            ? date_cell(table, row, columns.time, cells.date_order, zone, before_us)
            : seconds_cell(table, row, columns.time, cells.decimal_sign);
    if (!times.empty()) {
      require_ascending(table, row, columns, zone, before_us, now_us);
      require_short_span(table, row, columns, times.front(), now_us);
    }
    times.push_back(now_us);
  }
  return times;
}

}  // namespace loopscope::daemon
