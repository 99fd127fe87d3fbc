// Rows of a historian as libpq hands them over: any cells are read or refused (MalformedArray), and
// what a server can truly send keeps what scan_rows.hpp promises, through to the loop's window.

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/signal/assemble.hpp"
#include "core/signal/base_interval.hpp"
#include "storage/historian/merge_series.hpp"
#include "storage/historian/mode_codes.hpp"
#include "storage/historian/native_time.hpp"
#include "tests/fuzz/array_reader.hpp"
#include "tests/fuzz/historian_answer.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"

namespace loopscope::tests::fuzz {
namespace {

using core::signal::RawSeries;
using storage::RowOrder;

bool same_series(const RawSeries& a, const RawSeries& b) {
  const auto same = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  return a.time_us == b.time_us &&
         std::equal(a.value.begin(), a.value.end(), b.value.begin(), b.value.end(), same);
}

void check_values(const RawSeries& series) {
  require(series.time_us.size() == series.value.size(), "a time for every value");
  for (const double value : series.value)
    require(!std::isinf(value), "an infinite value is a missing one");
}

void check_span(const RawSeries& series, const storage::Scan& scan, bool before) {
  require(std::is_sorted(series.time_us.begin(), series.time_us.end()), "times ascend");
  const auto& times = series.time_us;
  const auto early = std::lower_bound(times.begin(), times.end(), scan.from_us) - times.begin();
  require(early <= (before ? 1 : 0), "nothing before the span but the one row before it");
  require(times.empty() || times.back() <= scan.to_us || early == 1, "nothing behind the span");
}

/// The parts of one tag as one series, its modes, and a window on its grid.
void check_use(const std::vector<RawSeries>& parts, const storage::Scan& scan) {
  const storage::TagRequest request{"tag", scan.from_us, scan.to_us, scan.max_rows};
  RawSeries merged = storage::merge_series(parts, request);
  check_values(merged);
  require(std::is_sorted(merged.time_us.begin(), merged.time_us.end()), "merged times ascend");
  RawSeries modes = merged;
  storage::decode_modes(modes, {});
  for (const double mode : modes.value)
    require(std::isnan(mode) || (mode >= 0.0 && mode <= 3.0), "a mode has a meaning");
  const double interval = std::max(core::signal::base_interval_s(merged), 0.001);
  const auto grid = core::signal::window_grid(merged, interval, scan.to_us, 256);
  const auto window = core::signal::assemble({merged, merged, merged, {}, modes}, grid, {});
  require(window.size() == grid.size, "the window fills its grid");
}

/// What the statement is sent: an array of one element for each part of the key and each bound.
void check_question(const HistorianAnswer& made) {
  const auto parameters = storage::scan_parameters({made.scan}, made.layout);
  require(parameters.size() == made.layout.key.size() + 4, "key, span, rows, row before");
  for (const std::string& parameter : parameters)
    require(read_array(parameter).size() == 1, "one element for one scan");
  const storage::TimeKind kind = made.layout.layout.time_kind;
  const auto from = storage::native_bound(kind, made.scan.from_us, storage::Bound::lower);
  require(read_array(parameters.at(made.layout.key.size())).front() == from ||
              !made.layout.nanos.empty(),
          "a span begins where it was asked to");
  require(!storage::native_text(kind, made.scan.to_us).empty(), "every time has its text");
}

void check_row(const HistorianAnswer& made, int row, std::vector<RawSeries>& parts) {
  // Not a structured binding: clang 14 does not let lambdas capture one.
  const storage::ResolvedLayout& layout = made.layout;
  const storage::Scan& scan = made.scan;
  const storage::PqRows& rows = made.rows;
  (void)storage::slot_of(rows, row, 1);
  (void)storage::rows_of_span(rows, row, layout);
  for (std::size_t column = 0; column < scan.columns.size(); ++column) {
    const auto read = [&](RowOrder order) {
      return storage::read_column(rows, row, scan, column, scan.columns, layout, order);
    };
    const RawSeries series = read(RowOrder::newest_first);
    check_values(series);
    const RawSeries any = read(RowOrder::any);
    check_values(any);
    if (!made.sane) continue;
    const bool before = scan.columns[column].before;
    check_span(series, scan, before);
    check_span(any, scan, before);
    require(same_series(series, any), "the same rows in any order make the same series");
    parts.push_back(series);
  }
}

}  // namespace

int fuzz_historian_rows(const std::uint8_t* data, std::size_t size) {
  ByteSource source(data, size);
  const HistorianAnswer made = make_answer(source);
  check_question(made);
  std::vector<core::signal::RawSeries> parts;
  for (int row = 0; row < made.rows.size(); ++row) {
    try {
      check_row(made, row, parts);
    } catch (const storage::MalformedArray&) {
      require(!made.sane, "what a server sends is understood");
    }
  }
  check_use(parts, made.scan);
  return 0;
}

}  // namespace loopscope::tests::fuzz
