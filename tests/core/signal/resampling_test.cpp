// Identities of resampling that hold of any rows on any grid.

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/signal/assemble.hpp"
#include "tests/core/signal/arbitrary_samples.hpp"

namespace loopscope::core::signal {
namespace {

constexpr auto kHolds = {Hold::sample, Hold::step, Hold::linear};

/// Slot that a row is nearest to; may lie outside the grid.
double slot_of(const Grid& grid, std::int64_t time_us) {
  return std::floor(elapsed_us(grid.start_us, time_us) / (grid.sample_interval_s * 1e6) + 0.5);
}

/// What Hold::sample and Hold::step say in one slot, row by row from the definition.
double by_definition(const RawSeries& rows, const Grid& grid, std::size_t k, Hold hold) {
  double value = kMissing;
  for (std::size_t row = 0; row < rows.time_us.size(); ++row) {
    const double slot = slot_of(grid, rows.time_us[row]);
    const auto here = static_cast<double>(k);
    if (hold == Hold::step ? slot <= here : slot == here) value = rows.value[row];
  }
  return value;
}

RC_GTEST_PROP(Resampling, SlotsHoldTheLastRowThatIsTheirs, ()) {
  const RawSeries rows = *arbitrary_rows();
  const Grid grid = *arbitrary_grid();
  for (const Hold hold : {Hold::sample, Hold::step}) {
    const Samples slots = align(rows, grid, hold);
    RC_ASSERT(slots.size() == grid.size);
    for (std::size_t k = 0; k < grid.size; ++k)
      RC_ASSERT(same(slots[k], by_definition(rows, grid, k, hold)));
  }
}

RC_GTEST_PROP(Resampling, RowsOnTheGridComeBackUnderAnyHold, ()) {
  const Samples values = *samples_with_gaps();
  const Grid grid{*rc::gen::inRange<std::int64_t>(-1'000'000'000, 1'000'000'000), 2.0,
                  values.size()};
  RawSeries rows;
  for (std::size_t k = 0; k < values.size(); ++k) {
    rows.time_us.push_back(grid.time_us(k));
    rows.value.push_back(values[k]);
  }
  for (const Hold hold : kHolds) RC_ASSERT(same(align(rows, grid, hold), values));
}

RC_GTEST_PROP(Resampling, LinesStayBetweenTheValuesOfTheRows, ()) {
  const RawSeries rows = *arbitrary_rows();
  const Grid grid = *arbitrary_grid();
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double value : rows.value) {
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  for (const double value : align(rows, grid, Hold::linear))
    RC_ASSERT(std::isnan(value) || (value >= low - 1e-9 && value <= high + 1e-9));
}

RC_GTEST_PROP(Resampling, ShiftingTheClockChangesNothing, ()) {
  const RawSeries rows = *arbitrary_rows();
  const Grid grid = *arbitrary_grid();
  const auto shift = *rc::gen::inRange<std::int64_t>(-4'000'000'000'000'000, 4'000'000'000'000'000);
  RawSeries later = rows;
  for (std::int64_t& time_us : later.time_us) time_us += shift;
  Grid later_grid = grid;
  later_grid.start_us += shift;
  for (const Hold hold : kHolds)
    RC_ASSERT(same(align(later, later_grid, hold), align(rows, grid, hold)));
}

RC_GTEST_PROP(Resampling, RowsFarFromTheGridDoNotCountButForWhatTheyHold, ()) {
  const RawSeries rows = *arbitrary_rows();
  const Grid grid = *arbitrary_grid();
  RawSeries more = rows;
  more.time_us.insert(more.time_us.begin(), -1'000'000'000'000);
  more.value.insert(more.value.begin(), kMissing);
  more.time_us.push_back(1'000'000'000'000);
  more.value.push_back(kMissing);
  for (const Hold hold : kHolds) RC_ASSERT(same(align(more, grid, hold), align(rows, grid, hold)));
}

RC_GTEST_PROP(Resampling, AWindowsGridEndsWithTheWindowAndBeginsWithTheRows, ()) {
  const RawSeries rows = *arbitrary_rows();
  const double interval_s = *rc::gen::element(0.1, 1.0, 10.0, 60.0);
  const auto end_us = *rc::gen::inRange<std::int64_t>(-1'000'000, 90'000'000'000);
  const auto most = *rc::gen::inRange<std::size_t>(1, 5000);
  const Grid grid = window_grid(rows, interval_s, end_us, most);
  RC_ASSERT(grid.size <= most);
  if (rows.time_us.front() > end_us) {
    RC_ASSERT(grid.size == 0U);
    return;
  }
  RC_ASSERT(grid.size > 0U);
  const double half_us = 0.5e6 * interval_s;
  const double behind_us = elapsed_us(end_us, grid.time_us(grid.size - 1));
  RC_ASSERT(behind_us <= half_us + 1.0);
  RC_ASSERT(behind_us > -2.0 * half_us - 1.0);
  RC_ASSERT(elapsed_us(rows.time_us.front(), grid.start_us) >= -half_us - 1.0);
}

RC_GTEST_PROP(Resampling, MovingByTheDistanceArrives, ()) {
  const auto from = *rc::gen::arbitrary<std::int64_t>();
  const auto by = *rc::gen::inRange<std::int64_t>(-(std::int64_t{1} << 52), std::int64_t{1} << 52);
  std::int64_t to = 0;
  RC_PRE(!__builtin_add_overflow(from, by, &to));
  RC_ASSERT(elapsed_us(from, to) == static_cast<double>(by));
  RC_ASSERT(moved_us(from, elapsed_us(from, to)) == to);
}

RC_GTEST_PROP(Resampling, AWindowIsAsLongAsItsGridInEverySeries, ()) {
  LoopRows rows{*arbitrary_rows(), *arbitrary_rows(), *arbitrary_rows(), {}, *arbitrary_rows()};
  rows.pv.hold = *rc::gen::elementOf(kHolds);
  const Grid grid = *arbitrary_grid();
  const LoopWindow window = assemble(rows, grid, std::nullopt);
  RC_ASSERT(window.size() == grid.size);
  RC_ASSERT(window.sp.size() == grid.size);
  RC_ASSERT(window.op.size() == grid.size);
  RC_ASSERT(window.mode.size() == grid.size);
  RC_ASSERT(window.mv.empty());
  for (std::size_t k = 0; k < window.pv_rows.size(); ++k)
    RC_ASSERT(std::isnan(window.pv_rows[k]) || same(window.pv_rows[k], window.pv[k]) ||
              rows.pv.hold == Hold::linear);
}

}  // namespace
}  // namespace loopscope::core::signal
