#include "daemon/recording/recording.hpp"

#include "core/signal/base_interval.hpp"
#include "daemon/recording/columns.hpp"
#include "daemon/recording/decimal_sign.hpp"
#include "daemon/recording/row_times.hpp"
#include "daemon/text/cell_failure.hpp"
#include "daemon/text/cells.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::RawSeries;

double number_cell(const CsvTable& table, const CsvTable::Row& row, std::size_t column,
                   char decimal_sign) {
  const std::string& cell = row.cells[column];
  if (const std::optional<double> value = parse_number(cell, decimal_sign)) return *value;
  const bool other = parse_number(cell, decimal_sign == '.' ? ',' : '.').has_value();
  const char* hint = "use a decimal point; leave a missing value empty";
  if (decimal_sign == ',')
    hint = "numbers of this file have decimal commas: all of them, and nothing between thousands";
  else if (other)
    hint = "use a decimal point, or say --decimal-sign comma; leave a missing value empty";
  throw cell_failure(table, row, column, shown(cell) + " is not a number", hint);
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

/// Those whose cells are numbers.
std::vector<std::size_t> number_columns(const Columns& columns) {
  std::vector<std::size_t> numbers{columns.pv};
  if (!columns.absolute_time) numbers.push_back(columns.time);
  for (const auto& column : {columns.sp, columns.op, columns.mv})
    if (column) numbers.push_back(*column);
  return numbers;
}

/// How the file was understood, where it is none as contract.md describes it.
std::vector<std::string> notes_on(const CsvTable& table, const Columns& columns,
                                  char decimal_sign) {
  std::vector<std::string> notes = column_notes(table, columns);
  if (table.separator != ',' || decimal_sign != '.') {
    notes.push_back(std::string("cells are separated by ") +
                    std::string(separators_text(table.separator)) + ", the decimal sign is " +
                    (decimal_sign == ',' ? "the comma" : "the point"));
  }
  return notes;
}

/// What tells a file of the kind that parse_recording() reads from others.
HeaderTest header_test(const RecordingForm& form) {
  return [&form](const std::vector<std::string>& header) {
    return is_header_of_recording(header, form);
  };
}

}  // namespace

Recording parse_recording(const CsvTable& table, const RecordingForm& form, const TimeZone& zone) {
  const Columns columns = find_columns(table, form);
  const char decimal_sign = find_decimal_sign(table, number_columns(columns), form.decimal_sign);
  const std::vector<std::int64_t> times =
      read_times(table, columns, {decimal_sign, form.date_order}, zone);
  const auto numbers = [&](const CsvTable::Row& row, std::size_t column) {
    return number_cell(table, row, column, decimal_sign);
  };
  const auto modes = [](const CsvTable::Row& row, std::size_t column) {
    return static_cast<double>(parse_mode(row.cells[column]));
  };
  Recording recording{
      table.name, columns.absolute_time, {}, notes_on(table, columns, decimal_sign)};
  recording.rows.pv = read_column(table, times, columns.pv, numbers);
  recording.rows.sp = read_column(table, times, columns.sp, numbers);
  recording.rows.op = read_column(table, times, columns.op, numbers);
  recording.rows.mv = read_column(table, times, columns.mv, numbers);
  recording.rows.mode = read_column(table, times, columns.mode, modes);
  if (columns.quality) mask_bad_quality(table, *columns.quality, recording.rows);
  return recording;
}

Recording parse_recording(std::string_view text, const std::string& name, const RecordingForm& form,
                          const TimeZone& zone) {
  return parse_recording(parse_csv(text, name, find_csv_form(text, name, header_test(form))), form,
                         zone);
}

Recording read_recording(const std::filesystem::path& file, const RecordingForm& form,
                         const TimeZone& zone) {
  return parse_recording(read_csv(file, header_test(form)), form, zone);
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
