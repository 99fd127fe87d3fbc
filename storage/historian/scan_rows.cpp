#include "storage/historian/scan_rows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/signal/loop_window.hpp"
#include "core/signal/microseconds.hpp"
#include "storage/array_literal.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/scan.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

using core::signal::kMissing;
using core::signal::RawSeries;

// Columns of the answer: slot, times, rows of unknown quality, then the values of each column, then
// time and value of the row before of each column that wants one.
constexpr int kTimes = 1;
constexpr int kUnknown = 2;
constexpr int kFirstValues = 3;

/// NULL on the wire, told apart from a NaN that the server sent by bits that it never sends.
constexpr std::uint64_t kNullBits = 0x7FF8'0000'0000'0A55;

/// Position of a column's row before among the answer's columns.
int before_column(const std::vector<ScanColumn>& asked, std::size_t column) {
  int position = kFirstValues + static_cast<int>(asked.size());
  for (std::size_t k = 0; k < column; ++k) position += asked[k].before ? 2 : 0;
  return position;
}

double finite_or_missing(std::uint64_t bits) {
  const auto value = std::bit_cast<double>(bits);
  return std::isfinite(value) ? value : kMissing;
}

/// Missing values first, then by size; -0.0 before 0.0, which compare as equal but are other bits.
bool comes_before(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && !std::isnan(b);
  return a < b || (a == b && std::signbit(a) && !std::signbit(b));
}

/// Puts rows with the same time into the order of their values.
void settle_ties(RawSeries& series) {
  for (std::size_t first = 0, end = 0; first < series.time_us.size(); first = end) {
    for (end = first + 1;
         end < series.time_us.size() && series.time_us[end] == series.time_us[first];) {
      ++end;
    }
    if (end - first == 1) continue;
    const auto begin = series.value.begin();
    std::sort(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(end),
              comes_before);
  }
}

/// The limit may have cut through rows of one time, and which of them came is anybody's guess.
void drop_oldest_time(RawSeries& series) {
  const auto end =
      std::upper_bound(series.time_us.begin(), series.time_us.end(), series.time_us.front());
  const auto count = end - series.time_us.begin();
  if (static_cast<std::size_t>(count) == series.time_us.size()) return;
  series.time_us.erase(series.time_us.begin(), end);
  series.value.erase(series.value.begin(), series.value.begin() + count);
}

/// The bits of the rows, newest first.
struct Wire {
  std::vector<std::uint64_t> times, values;
};

/// The rows not before a time. A table mostly has its rows oldest first, but for those that came
/// late.
Wire newest_first(const Wire& wire, TimeKind kind, std::int64_t from_us) {
  std::vector<std::pair<std::int64_t, std::size_t>> places;
  for (std::size_t k = wire.times.size(); k-- > 0;) {
    const std::int64_t time_us = microseconds(kind, wire.times[k]);
    if (time_us >= from_us) places.emplace_back(time_us, k);
  }
  if (!std::ranges::is_sorted(places, std::ranges::greater()))
    std::ranges::sort(places, std::ranges::greater());
  Wire sorted;
  for (const auto& [time_us, place] : places) {
    sorted.times.push_back(wire.times[place]);
    sorted.values.push_back(wire.values[place]);
  }
  return sorted;
}

Wire take_wire(const PqRows& rows, int row, std::size_t column, TimeKind kind) {
  Wire wire;
  const int values = kFirstValues + static_cast<int>(column);
  if (!rows.is_null(row, kTimes)) {
    wire.times = decode_array(rows.bytes(row, kTimes), native_element(kind), 0);
    wire.values = decode_array(rows.bytes(row, values), ElementType::float8, kNullBits);
  }
  if (wire.times.size() != wire.values.size()) {
    throw MalformedArray("times and values differ in number");
  }
  return wire;
}

/// The row before, where the scan wants one and there is one: the oldest of all.
void add_row_before(const PqRows& rows, int row, int column, Wire& wire) {
  if (rows.is_null(row, column)) return;
  wire.times.push_back(decode_value(rows.bytes(row, column)));
  wire.values.push_back(rows.is_null(row, column + 1) ? kNullBits
                                                      : decode_value(rows.bytes(row, column + 1)));
}

/// What the statement's bounds let through that the span does not: whole seconds beside
/// nanoseconds, clocks that were put back.
void trim(RawSeries& series, const Scan& scan, bool before) {
  const auto erase = [&series](std::ptrdiff_t first, std::ptrdiff_t end) {
    series.time_us.erase(series.time_us.begin() + first, series.time_us.begin() + end);
    series.value.erase(series.value.begin() + first, series.value.begin() + end);
  };
  const auto position = [&series](auto bound) { return bound - series.time_us.begin(); };
  auto& times = series.time_us;
  erase(position(std::upper_bound(times.begin(), times.end(), scan.to_us)),
        static_cast<std::ptrdiff_t>(times.size()));
  const std::ptrdiff_t earlier =
      position(std::lower_bound(times.begin(), times.end(), scan.from_us));
  erase(0, before && earlier > 0 ? earlier - 1 : earlier);
}

/// The lower bound as the time column sees it: beside nanoseconds it may hold full seconds only.
std::int64_t first_time(const Scan& scan, const ResolvedLayout& layout) {
  if (layout.nanos.empty()) return scan.from_us;
  const std::int64_t from = clamp_time(scan.from_us);
  const std::int64_t fraction =
      ((from % core::signal::kSecond_us) + core::signal::kSecond_us) % core::signal::kSecond_us;
  return from - fraction;
}

std::vector<std::string> constants_of(const Scan& scan, const ResolvedLayout& layout) {
  const TimeKind kind = layout.layout.time_kind;
  std::vector<std::string> parameters = scan.key;
  parameters.push_back(std::to_string(std::max<std::int64_t>(scan.max_rows, 0)));
  const std::int64_t from = first_time(scan, layout);
  parameters.push_back(native_bound(kind, from, Bound::lower));
  parameters.push_back(native_bound(kind, scan.to_us, Bound::upper));
  for (const std::int64_t span_us : kGrowingSpans_us)
    parameters.push_back(native_bound(kind, clamp_time(from) - span_us, Bound::lower));
  return parameters;
}

}  // namespace

std::string bound_before(const Scan& scan, const ResolvedLayout& layout) {
  const std::int64_t time =
      wants_before(scan) ? clamp_time(scan.from_us) - kReachBefore_us : first_time(scan, layout);
  return native_bound(layout.layout.time_kind, time, Bound::lower);
}

std::vector<std::string> scan_parameters(const std::vector<Scan>& batch,
                                         const ResolvedLayout& layout) {
  if (layout.foreign) return constants_of(batch.front(), layout);
  const TimeKind kind = layout.layout.time_kind;
  std::vector<std::string> parameters;
  for (std::size_t part = 0; part < layout.key.size(); ++part) {
    ArrayLiteral keys;
    for (const Scan& scan : batch) keys.add_text(scan.key[part]);
    parameters.push_back(keys.text());
  }
  ArrayLiteral from, to, max_rows, before;
  for (const Scan& scan : batch) {
    from.add_text(native_bound(kind, first_time(scan, layout), Bound::lower));
    to.add_text(native_bound(kind, scan.to_us, Bound::upper));
    max_rows.add_integer(std::max<std::int64_t>(scan.max_rows, 0));
    before.add_text(bound_before(scan, layout));
  }
  for (const ArrayLiteral* array : {&from, &to, &max_rows, &before})
    parameters.push_back(array->text());
  return parameters;
}

RawSeries read_column(const PqRows& rows, int row, const Scan& scan, std::size_t column,
                      const std::vector<ScanColumn>& asked, const ResolvedLayout& layout,
                      RowOrder order) {
  const TimeKind kind = layout.layout.time_kind;
  Wire wire = take_wire(rows, row, column, kind);
  if (order == RowOrder::any) wire = newest_first(wire, kind, scan.from_us);
  if (scan.columns[column].before) add_row_before(rows, row, before_column(asked, column), wire);
  RawSeries series;
  series.time_us.reserve(wire.times.size());
  series.value.reserve(wire.times.size());
  bool repeated = false;
  for (std::size_t k = wire.times.size(); k-- > 0;) {
    if (layout.layout.null_is_absent && wire.values[k] == kNullBits) continue;
    const std::int64_t time_us = microseconds(kind, wire.times[k]);
    repeated = repeated || (!series.empty() && series.time_us.back() == time_us);
    series.time_us.push_back(time_us);
    series.value.push_back(finite_or_missing(wire.values[k]));
  }
  if (repeated && layout.tiebreak.empty()) {
    settle_ties(series);
    if (static_cast<std::int64_t>(wire.times.size()) >= scan.max_rows) drop_oldest_time(series);
  }
  trim(series, scan, scan.columns[column].before);
  series.unknown_quality = static_cast<std::size_t>(decode_value(rows.bytes(row, kUnknown)));
  return series;
}

std::size_t rows_of_span(const PqRows& rows, int row, const ResolvedLayout& layout) {
  if (rows.is_null(row, kTimes)) return 0;
  return array_length(rows.bytes(row, kTimes), native_element(layout.layout.time_kind));
}

std::size_t slot_of(const PqRows& rows, int row, std::size_t slots) {
  const std::uint64_t slot = decode_value(rows.bytes(row, 0));
  if (slot < 1 || slot > slots) throw MalformedArray("a row of an unknown slot");
  return static_cast<std::size_t>(slot - 1);
}

}  // namespace loopscope::storage
