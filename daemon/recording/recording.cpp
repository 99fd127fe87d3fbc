#include "daemon/recording/recording.hpp"

#include "core/signal/base_interval.hpp"
#include "daemon/recording/columns.hpp"
#include "daemon/recording/row_times.hpp"
#include "daemon/text/cell_failure.hpp"
#include "daemon/text/cells.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::RawSeries;

double number_cell(const CsvTable& table, const CsvTable::Row& row, std::size_t column) {
  const std::optional<double> value = parse_number(row.cells[column]);
  if (value) return *value;
  throw cell_failure(table, row, column, shown(row.cells[column]) + " is not a number",
                     "use a decimal point; leave a missing value empty");
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

void mask_bad_quality(const CsvTable& table, std::size_t column, core::signal::LoopRows& rows) {
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    if (is_good_quality(table.rows[k].cells[column])) continue;
    for (RawSeries* series : {&rows.sp, &rows.pv, &rows.op, &rows.mv}) {
      if (!series->empty()) series->value[k] = core::signal::kMissing;
    }
  }
}

}  // namespace

Recording parse_recording(const CsvTable& table, const TimeZone& zone) {
  const Columns columns = find_columns(table);
  const std::vector<std::int64_t> times = read_times(table, columns, zone);
  const auto numbers = [&](const CsvTable::Row& row, std::size_t column) {
    return number_cell(table, row, column);
  };
  const auto modes = [](const CsvTable::Row& row, std::size_t column) {
    return static_cast<double>(parse_mode(row.cells[column]));
  };
  Recording recording{table.name, columns.absolute_time, {}};
  recording.rows.pv = read_column(table, times, columns.pv, numbers);
  recording.rows.sp = read_column(table, times, columns.sp, numbers);
  recording.rows.op = read_column(table, times, columns.op, numbers);
  recording.rows.mv = read_column(table, times, columns.mv, numbers);
  recording.rows.mode = read_column(table, times, columns.mode, modes);
  if (columns.quality) mask_bad_quality(table, *columns.quality, recording.rows);
  return recording;
}

Recording read_recording(const std::filesystem::path& file, const TimeZone& zone) {
  return parse_recording(read_csv(file), zone);
}

core::signal::LoopWindow last_window(const Recording& recording, std::size_t max_samples,
                                     const std::optional<core::signal::OpRange>& op_range,
                                     std::optional<std::int64_t> end_us) {
  const RawSeries& pv = recording.rows.pv;
  const double usual = core::signal::base_interval_s(pv);
  const double interval = usual > 0.0 ? usual : 1.0;
  const std::int64_t end = end_us.value_or(pv.empty() ? 0 : pv.time_us.back());
  return core::signal::assemble(
      recording.rows, core::signal::window_grid(pv, interval, end, max_samples), op_range);
}

}  // namespace loopscope::daemon
