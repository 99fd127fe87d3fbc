// Recordings: any text becomes rows and a window, or Failure (unusable data) with a hint.

#include <algorithm>
#include <cmath>

#include "core/signal/window_digest.hpp"
#include "daemon/output/window_csv.hpp"
#include "daemon/recording/recording.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/text_target.hpp"

namespace loopscope::tests::fuzz {
namespace {

using core::signal::LoopWindow;
using core::signal::RawSeries;

constexpr std::size_t kMostSamples = 4096;

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k)
    line += (k == 0 ? "" : ",") + daemon::csv_cell(cells[k]);
  // A lone empty cell would be a blank line, which no table has.
  return line + "\n";
}

/// A table written as CSV is the same table.
void check_table(const daemon::CsvTable& table) {
  std::string text = "\xEF\xBB\xBF" + csv_line(table.header);
  for (const auto& row : table.rows) text += csv_line(row.cells);
  const daemon::CsvTable again = daemon::parse_csv(text, "again");
  require(again.header == table.header, "the header comes back");
  require(again.rows.size() == table.rows.size(), "every row comes back");
  for (std::size_t k = 0; k < table.rows.size(); ++k)
    require(again.rows[k].cells == table.rows[k].cells, "every cell comes back");
}

void check_tables(std::string_view text) {
  for (const char separator : {',', ';', '\t'}) {
    try {
      check_table(daemon::parse_csv(text, "file", {.separator = separator}));
    } catch (const daemon::Failure&) {  // no table by this separator; the recording may be one
    }
  }
}

void check_series(const RawSeries& series, const RawSeries& pv) {
  require(series.time_us.size() == series.value.size(), "a time for every value");
  require(series.empty() || series.time_us == pv.time_us, "all series have pv's times");
  require(std::is_sorted(series.time_us.begin(), series.time_us.end()), "times ascend");
  for (const double value : series.value)
    require(!std::isinf(value), "an infinite value is a missing one");
}

void check_window(const LoopWindow& window) {
  require(window.size() <= kMostSamples, "no more samples than asked for");
  require(window.sample_interval_s > 0.0 && std::isfinite(window.sample_interval_s),
          "the interval is a time");
  for (const auto* samples : {&window.sp, &window.op, &window.mv, &window.pv_rows})
    require(samples->empty() || samples->size() == window.size(), "as long as pv or empty");
  require(window.mode.empty() || window.mode.size() == window.size(), "modes as long as pv");
}

void check_written(const LoopWindow& window) {
  if (window.size() == 0) return;
  const auto again =
      daemon::parse_recording(daemon::parse_csv(daemon::window_csv(window), "again"));
  require(again.rows.pv.value.size() == window.size(), "a row for every sample");
  for (std::size_t k = 0; k < window.size(); ++k) {
    const double written = again.rows.pv.value[k];
    require(written == window.pv[k] || (std::isnan(written) && std::isnan(window.pv[k])),
            "values come back to the last bit");
  }
}

/// What commas and the usual names make a recording of is that recording.
void check_as_ever(std::string_view text, const daemon::Recording& recording) {
  const daemon::CsvTable table = daemon::parse_csv(text, "file");
  const auto has = [&](std::string_view name) {
    return std::ranges::any_of(table.header, [&](const std::string& cell) {
      return daemon::same_word(daemon::trimmed(cell), name);
    });
  };
  if (!has("pv") || (!has("t_s") && !has("time"))) return;
  const daemon::Recording usual = daemon::parse_recording(table);
  const auto same = [](const RawSeries& a, const RawSeries& b) {
    return a.time_us == b.time_us && std::ranges::equal(a.value, b.value, [](double x, double y) {
             return x == y || (std::isnan(x) && std::isnan(y));
           });
  };
  require(same(recording.rows.pv, usual.rows.pv) && same(recording.rows.sp, usual.rows.sp) &&
              same(recording.rows.op, usual.rows.op),
          "commas and the usual names go before what else a header may say");
}

void check_recording(std::string_view text) {
  check_tables(text);
  const daemon::Recording recording = daemon::parse_recording(text, "file");
  check_as_ever(text, recording);
  const auto& rows = recording.rows;
  for (const RawSeries* series : {&rows.sp, &rows.pv, &rows.op, &rows.mv, &rows.mode})
    check_series(*series, rows.pv);
  const LoopWindow window = daemon::last_window(recording, kMostSamples, {});
  check_window(window);
  const LoopWindow again = daemon::last_window(recording, kMostSamples, {});
  require(core::signal::window_digest(window, "") == core::signal::window_digest(again, ""),
          "the same rows give the same window");
  if (recording.absolute_time) check_written(window);
}

}  // namespace

int fuzz_recording(const std::uint8_t* data, std::size_t size) {
  return check_as_text(data, size, [](const auto& text) { check_recording(text); });
}

}  // namespace loopscope::tests::fuzz
