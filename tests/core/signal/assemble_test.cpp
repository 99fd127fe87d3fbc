#include "core/signal/assemble.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/core/signal/raw_rows.hpp"

namespace loopscope::core::signal {
namespace {

using tests::kSecond;

RawSeries ramp(std::int64_t first_s, std::int64_t step_s, std::size_t count) {
  RawSeries rows;
  for (std::size_t k = 0; k < count; ++k) {
    rows.time_us.push_back((first_s + step_s * static_cast<std::int64_t>(k)) * kSecond);
    rows.value.push_back(static_cast<double>(k));
  }
  return rows;
}

TEST(WindowGrid, EndsAtTheSlotAndHoldsTheLastSamples) {
  const Grid grid = window_grid(ramp(0, 10, 1000), 10.0, 9990 * kSecond, 100);
  EXPECT_EQ(grid.size, 100U);
  EXPECT_EQ(grid.time_us(99), 9990 * kSecond);
}

TEST(WindowGrid, AShortRecordIsNotPaddedAtItsStart) {
  const Grid grid = window_grid(ramp(0, 10, 50), 10.0, 490 * kSecond, 100);
  EXPECT_EQ(grid.size, 50U);
  EXPECT_EQ(grid.start_us, 0);
}

TEST(WindowGrid, SamplesMissingAtTheEndBelongToTheWindow) {
  const Grid grid = window_grid(ramp(0, 10, 50), 10.0, 590 * kSecond, 100);
  EXPECT_EQ(grid.size, 60U);
  EXPECT_EQ(grid.time_us(59), 590 * kSecond);
}

TEST(WindowGrid, KeepsThePhaseOfTheSamples) {
  const Grid grid = window_grid(ramp(3, 10, 50), 10.0, 300 * kSecond, 10);
  EXPECT_EQ(grid.time_us(9), 293 * kSecond);
  EXPECT_EQ(grid.size, 10U);
}

TEST(WindowGrid, RowsAfterTheSlotDoNotCount) {
  EXPECT_EQ(window_grid(ramp(100, 10, 5), 10.0, 99 * kSecond, 10).size, 0U);
  EXPECT_EQ(window_grid({}, 10.0, 0, 10).size, 0U);
}

TEST(WindowGrid, TimesFurtherApartThanTheirTypeCanSay) {
  const std::int64_t far_s = 9'000'000'000'000;
  const RawSeries pv{{-far_s * kSecond, far_s * kSecond}, {1.0, 2.0}};
  const Grid seconds = window_grid(pv, 1.0, far_s * kSecond, 100);
  EXPECT_EQ(seconds.size, 100U);
  EXPECT_EQ(seconds.start_us, (far_s - 99) * kSecond);
  const double whole_s = usual_interval_s(pv);
  EXPECT_EQ(whole_s, 1.8e13);
  const Grid whole = window_grid(pv, whole_s, far_s * kSecond, 100);
  EXPECT_EQ(whole.size, 2U);
  EXPECT_EQ(whole.start_us, -far_s * kSecond);
  EXPECT_EQ(align(pv, whole, Hold::sample), pv.value);
}

TEST(Assemble, EachTagIsAlignedAfterItsKind) {
  LoopRows rows;
  rows.pv = ramp(0, 10, 4);
  rows.sp = {{-50 * kSecond, 20 * kSecond}, {7.0, 8.0}};
  rows.op = ramp(0, 10, 4);
  rows.mode = {{0}, {1.0}};
  const LoopWindow window = assemble(rows, {0, 10.0, 4}, OpRange{4.0, 20.0});
  EXPECT_EQ(window.pv, (Samples{0, 1, 2, 3}));
  EXPECT_EQ(window.sp, (Samples{7, 7, 8, 8}));
  EXPECT_EQ(window.op, window.pv);
  EXPECT_TRUE(window.mv.empty());
  EXPECT_EQ(window.mode, std::vector(4, ControlMode::automatic));
  EXPECT_EQ(window.op_range->high, 20.0);
}

TEST(Assemble, AModeThatIsNoKnownNumberIsUnknown) {
  LoopRows rows;
  rows.pv = ramp(0, 1, 3);
  rows.mode = {{0, kSecond, 2 * kSecond}, {0.0, 17.0, kMissing}};
  const LoopWindow window = assemble(rows, {0, 1.0, 3}, std::nullopt);
  EXPECT_EQ(window.mode[0], ControlMode::manual);
  EXPECT_EQ(window.mode[1], ControlMode::unknown);
  EXPECT_EQ(window.mode[2], ControlMode::unknown);
}

TEST(Assemble, EveryTagIsReconstructedAsItsArchiveDemands) {
  LoopRows rows;
  for (RawSeries* series : {&rows.pv, &rows.op, &rows.mv, &rows.sp}) *series = ramp(0, 20, 3);
  rows.op.hold = Hold::step;
  rows.mv.hold = rows.sp.hold = Hold::linear;
  const LoopWindow window = assemble(rows, {0, 10.0, 5}, std::nullopt);
  EXPECT_TRUE(std::isnan(window.pv[1]));
  EXPECT_EQ(window.op[1], 0.0);
  EXPECT_EQ(window.mv[1], 0.5);
  EXPECT_EQ(window.sp[1], 0.0) << "a setpoint is never drawn as a line";
}

TEST(Assemble, ARecordWithoutHolesIsTheSameWindowUnderWhateverArchive) {
  LoopRows rows;
  rows.pv = ramp(0, 10, 5);
  const Grid grid{0, 10.0, 5};
  for (const Hold hold : {Hold::sample, Hold::step, Hold::linear}) {
    rows.pv.hold = hold;
    const LoopWindow window = assemble(rows, grid, std::nullopt);
    EXPECT_TRUE(window.pv_rows.empty());
    EXPECT_EQ(window.pv, (Samples{0, 1, 2, 3, 4}));
  }
  rows.pv.time_us.erase(rows.pv.time_us.begin() + 2);
  rows.pv.value.erase(rows.pv.value.begin() + 2);
  EXPECT_EQ(assemble(rows, grid, std::nullopt).pv_rows.size(), 5U);
}

}  // namespace
}  // namespace loopscope::core::signal
