#include "core/signal/assemble.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>

#include "core/signal/microseconds.hpp"

namespace loopscope::core::signal {
namespace {

Samples align_if_recorded(const RawSeries& rows, const Grid& grid, Hold hold) {
  return rows.empty() ? Samples{} : align(rows, grid, hold);
}

std::vector<ControlMode> to_modes(const Samples& numbers) {
  std::vector<ControlMode> modes;
  modes.reserve(numbers.size());
  for (const double number : numbers) {
    const bool known = number >= 0.0 && number <= static_cast<double>(ControlMode::cascade);
    modes.push_back(known ? static_cast<ControlMode>(std::lround(number)) : ControlMode::unknown);
  }
  return modes;
}

/// pv where a row lies; empty where every value has a row of its own, so that a record without
/// holes is the same window under whatever archive.
Samples rows_unless_whole(const RawSeries& rows, const Grid& grid, const Samples& pv) {
  Samples at_rows = align(rows, grid, Hold::sample);
  const bool whole =
      std::equal(pv.begin(), pv.end(), at_rows.begin(), at_rows.end(),
                 [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
  return whole ? Samples{} : at_rows;
}

/// How much later than the newest row the usual row lies on a grid through the newest, in
/// microseconds, within half an interval: jitter of the newest row alone would move every slot. 0
/// where the rows lie on its grid, and where they agree on no grid.
double usual_phase(std::span<const std::int64_t> times_us, double interval_us,
                   std::size_t max_rows) {
  // Rounding of stamps; and less agreement than this is that of times which know no interval.
  constexpr double kRounding = 0.01;
  constexpr double kAgreement = 0.1;
  const std::int64_t newest = times_us.back();
  const auto rows = times_us.last(std::min(times_us.size(), max_rows));
  std::complex<double> sum = 0.0;
  for (const std::int64_t time_us : rows) {
    const double turns = elapsed_us(newest, time_us) / interval_us;
    const double off = turns - std::round(turns);
    // Nearly all rows of most archives lie on the grid.
    sum += off == 0.0 ? 1.0 : std::polar(1.0, 2.0 * std::numbers::pi * off);
  }
  const double phase = std::arg(sum) / (2.0 * std::numbers::pi);
  const bool agreed = std::abs(sum) > kAgreement * static_cast<double>(rows.size());
  return agreed && std::abs(phase) > kRounding ? phase * interval_us : 0.0;
}

}  // namespace

Grid window_grid(const RawSeries& pv, double sample_interval_s, std::int64_t end_us,
                 std::size_t max_samples) {
  Grid grid{end_us, sample_interval_s, 0};
  const auto after = std::upper_bound(pv.time_us.begin(), pv.time_us.end(), end_us);
  if (after == pv.time_us.begin()) return grid;
  const double interval_us = sample_interval_s * kMicrosecondsPerSecond;
  const auto within = static_cast<std::size_t>(after - pv.time_us.begin());
  const std::int64_t newest =
      moved_us(*std::prev(after),
               usual_phase(std::span(pv.time_us).first(within), interval_us, max_samples));
  const auto slots_between = [&](std::int64_t from, std::int64_t to, double round) {
    return std::floor(elapsed_us(from, to) / interval_us + round);
  };
  const double missing_at_end = slots_between(newest, end_us, 0.0);
  const double recorded = slots_between(pv.time_us.front(), newest, 0.5);
  const double available = missing_at_end + recorded + 1.0;
  grid.size = static_cast<std::size_t>(std::min(available, static_cast<double>(max_samples)));
  const double to_start = missing_at_end - (static_cast<double>(grid.size) - 1.0);
  grid.start_us = moved_us(newest, to_start * interval_us);
  return grid;
}

LoopWindow assemble(const LoopRows& rows, const Grid& grid,
                    const std::optional<OpRange>& op_range) {
  LoopWindow window;
  window.sample_interval_s = grid.sample_interval_s;
  window.start_us = grid.start_us;
  window.pv = align(rows.pv, grid, rows.pv.hold);
  if (rows.pv.hold != Hold::sample) window.pv_rows = rows_unless_whole(rows.pv, grid, window.pv);
  window.sp = align_if_recorded(rows.sp, grid, Hold::step);
  window.op = align_if_recorded(rows.op, grid, rows.op.hold);
  window.mv = align_if_recorded(rows.mv, grid, rows.mv.hold);
  window.mode = to_modes(align_if_recorded(rows.mode, grid, Hold::step));
  window.op_range = op_range;
  window.repeated_times = count_repeated_times(rows.pv);
  return window;
}

}  // namespace loopscope::core::signal
