#include "daemon/recording/recording.hpp"

#include <cmath>
#include <fmt/format.h>

#include "daemon/failure.hpp"
#include "daemon/recording/cells.hpp"
#include "daemon/recording/time_text.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::RawSeries;

constexpr double kMicrosecondsPerSecond = 1e6;
/// Beyond this many seconds (about 285 000 years) microseconds do not fit into 64 bits.
constexpr double kLargestTime = 9e12;

std::optional<std::size_t> find_column(const CsvTable& table, std::string_view name) {
  for (std::size_t column = 0; column < table.header.size(); ++column) {
    if (same_word(trimmed(table.header[column]), name)) return column;
  }
  return std::nullopt;
}

Failure cell_failure(const CsvTable& table, const CsvTable::Row& row, std::size_t column,
                     const std::string& problem, const std::string& hint) {
  return {ExitCode::unusable_data,
          fmt::format("{}, line {}, column \"{}\": {}", table.name, row.line,
                      trimmed(table.header[column]), problem),
          hint};
}

double number_cell(const CsvTable& table, const CsvTable::Row& row, std::size_t column) {
  const std::optional<double> value = parse_number(row.cells[column]);
  if (value) return *value;
  throw cell_failure(table, row, column, fmt::format("\"{}\" is not a number", row.cells[column]),
                     "use a decimal point; leave a missing value empty");
}

std::int64_t seconds_cell(const CsvTable& table, const CsvTable::Row& row, std::size_t column) {
  const double seconds = number_cell(table, row, column);
  if (std::isfinite(seconds) && std::abs(seconds) <= kLargestTime) {
    return std::llround(seconds * kMicrosecondsPerSecond);
  }
  throw cell_failure(table, row, column, fmt::format("\"{}\" is not a time", row.cells[column]),
                     "every row needs its time in seconds");
}

std::int64_t iso_cell(const CsvTable& table, const CsvTable::Row& row, std::size_t column) {
  const auto time = parse_time(trimmed(row.cells[column]));
  if (time) return *time;
  throw cell_failure(table, row, column, fmt::format("\"{}\" is not a time", row.cells[column]),
                     "write ISO 8601, e.g. 2026-03-01T12:00:00Z");
}

struct TimeColumn {
  std::size_t column = 0;
  bool absolute = false;
};

TimeColumn find_time_column(const CsvTable& table) {
  if (const auto column = find_column(table, "t_s")) return {*column, false};
  if (const auto column = find_column(table, "time")) return {*column, true};
  throw Failure(ExitCode::unusable_data,
                table.name + ", line 1: the header has neither \"t_s\" nor \"time\"",
                "name the columns, e.g. t_s,sp,pv,op, separated by commas");
}

std::size_t require_pv_column(const CsvTable& table) {
  if (const auto column = find_column(table, "pv")) return *column;
  throw Failure(ExitCode::unusable_data, table.name + ", line 1: the header has no \"pv\" column",
                "name the columns, e.g. t_s,sp,pv,op, separated by commas");
}

std::vector<std::int64_t> read_times(const CsvTable& table, const TimeColumn& time) {
  std::vector<std::int64_t> times;
  times.reserve(table.rows.size());
  for (const CsvTable::Row& row : table.rows) {
    const std::int64_t now =
        time.absolute ? iso_cell(table, row, time.column) : seconds_cell(table, row, time.column);
    if (!times.empty() && now < times.back()) {
      throw cell_failure(table, row, time.column,
                         fmt::format("the time {} runs backwards", row.cells[time.column]),
                         "sort the rows by time");
    }
    times.push_back(now);
  }
  return times;
}

/// Values of one column by `convert(row)`; empty when the file has no such column.
template <typename Convert>
RawSeries read_column(const CsvTable& table, const std::vector<std::int64_t>& times,
                      std::optional<std::size_t> column, Convert convert) {
  RawSeries series;
  if (!column) return series;
  series.time_us = times;
  series.value.reserve(times.size());
  for (const CsvTable::Row& row : table.rows) series.value.push_back(convert(row, *column));
  return series;
}

void mask_bad_quality(const CsvTable& table, core::signal::LoopRows& rows) {
  const auto column = find_column(table, "quality");
  if (!column) return;
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    if (is_good_quality(table.rows[k].cells[*column])) continue;
    for (RawSeries* series : {&rows.sp, &rows.pv, &rows.op, &rows.mv}) {
      if (!series->empty()) series->value[k] = core::signal::kMissing;
    }
  }
}

}  // namespace

Recording parse_recording(const CsvTable& table) {
  const TimeColumn time = find_time_column(table);
  const std::size_t pv_column = require_pv_column(table);
  const std::vector<std::int64_t> times = read_times(table, time);
  const auto numbers = [&](const CsvTable::Row& row, std::size_t column) {
    return number_cell(table, row, column);
  };
  const auto modes = [](const CsvTable::Row& row, std::size_t column) {
    return static_cast<double>(parse_mode(row.cells[column]));
  };
  Recording recording{table.name, time.absolute, {}};
  recording.rows.pv = read_column(table, times, pv_column, numbers);
  recording.rows.sp = read_column(table, times, find_column(table, "sp"), numbers);
  recording.rows.op = read_column(table, times, find_column(table, "op"), numbers);
  recording.rows.mv = read_column(table, times, find_column(table, "mv"), numbers);
  recording.rows.mode = read_column(table, times, find_column(table, "mode"), modes);
  mask_bad_quality(table, recording.rows);
  return recording;
}

Recording read_recording(const std::filesystem::path& file) {
  return parse_recording(read_csv(file));
}

core::signal::LoopWindow last_window(const Recording& recording, std::size_t max_samples,
                                     const std::optional<core::signal::OpRange>& op_range,
                                     std::optional<double> interval_s) {
  const RawSeries& pv = recording.rows.pv;
  const double usual = interval_s.value_or(core::signal::usual_interval_s(pv));
  const double interval = usual > 0.0 ? usual : 1.0;
  const std::int64_t end = pv.empty() ? 0 : pv.time_us.back();
  return core::signal::assemble(
      recording.rows, core::signal::window_grid(pv, interval, end, max_samples), op_range);
}

}  // namespace loopscope::daemon
