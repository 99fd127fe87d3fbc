#include "core/signal/grid.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "tests/core/signal/raw_rows.hpp"

namespace loopscope::core::signal {
namespace {

using tests::kSecond;
using tests::rows_at;
constexpr std::int64_t kEarliest = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kLatest = std::numeric_limits<std::int64_t>::max();

TEST(Grid, PeriodicRowsFillTheirOwnSlots) {
  const Samples samples = align(rows_at({0, 10, 20, 30}), {0, 10.0, 4}, Hold::sample);
  EXPECT_EQ(samples, (Samples{0, 1, 2, 3}));
}

TEST(Grid, JitteringRowsFallIntoTheNearestSlot) {
  const Samples samples = align(rows_at({0.4, 9.7, 20.3, 29.9}), {0, 10.0, 4}, Hold::sample);
  EXPECT_EQ(samples, (Samples{0, 1, 2, 3}));
}

TEST(Grid, ASlotWithoutARowIsMissing) {
  const Samples samples = align(rows_at({0, 30}), {0, 10.0, 4}, Hold::sample);
  EXPECT_EQ(samples[0], 0.0);
  EXPECT_TRUE(std::isnan(samples[1]));
  EXPECT_TRUE(std::isnan(samples[2]));
  EXPECT_EQ(samples[3], 1.0);
}

TEST(Grid, RowsOutsideAreLeftOut) {
  const Samples samples = align(rows_at({-10, 0, 10, 99}), {0, 10.0, 2}, Hold::sample);
  EXPECT_EQ(samples, (Samples{1, 2}));
}

TEST(Grid, TheLastOfSeveralRowsCounts) {
  const Samples samples = align(rows_at({0, 0, 0}), {0, 10.0, 1}, Hold::sample);
  EXPECT_EQ(samples, (Samples{2}));
}

TEST(Grid, StepsHoldFromBeforeTheGridOn) {
  const Samples samples = align(rows_at({-100, 15}), {0, 10.0, 4}, Hold::step);
  EXPECT_EQ(samples, (Samples{0, 0, 1, 1}));
}

TEST(Grid, ABadRowEndsAHold) {
  RawSeries rows = rows_at({0, 10});
  rows.value[1] = kMissing;
  const Samples samples = align(rows, {0, 10.0, 3}, Hold::step);
  EXPECT_EQ(samples[0], 0.0);
  EXPECT_TRUE(std::isnan(samples[1]) && std::isnan(samples[2]));
}

TEST(Grid, LinesRunFromRowToRow) {
  const Samples samples = align(rows_at({-10, 30, 40}), {0, 10.0, 6}, Hold::linear);
  EXPECT_EQ(Samples(samples.begin(), samples.begin() + 5), (Samples{0.25, 0.5, 0.75, 1, 2}));
  EXPECT_TRUE(std::isnan(samples[5])) << "nothing is known behind the last row";
}

TEST(Grid, JitteringRowsOnLinesFillTheirOwnSlots) {
  const Samples samples = align(rows_at({0.4, 10.3, 19.8}), {0, 10.0, 3}, Hold::linear);
  EXPECT_EQ(samples[0], 0.0);
  EXPECT_NEAR(samples[1], 9.6 / 9.9, 1e-12);
  EXPECT_EQ(samples[2], 2.0);
}

TEST(Grid, ABadRowBreaksTheLinesOnBothSides) {
  RawSeries rows = rows_at({0, 20, 40});
  rows.value[1] = kMissing;
  const Samples samples = align(rows, {0, 10.0, 5}, Hold::linear);
  EXPECT_EQ(samples[0], 0.0);
  for (const std::size_t k : {1U, 2U, 3U}) EXPECT_TRUE(std::isnan(samples[k])) << k;
  EXPECT_EQ(samples[4], 2.0);
}

TEST(Grid, OfTwoRowsAtOneTimeTheLastOneEndsAndBeginsTheLine) {
  const Samples samples = align(rows_at({0, 10, 10, 20}), {0, 10.0, 3}, Hold::linear);
  EXPECT_EQ(samples, (Samples{0, 2, 3}));
}

TEST(Grid, InfinityIsMissing) {
  RawSeries rows = rows_at({0});
  rows.value[0] = HUGE_VAL;
  EXPECT_TRUE(std::isnan(align(rows, {0, 1.0, 1}, Hold::sample)[0]));
}

TEST(Grid, AThirdOfASecondDoesNotDriftOverALongWindow) {
  RawSeries rows;
  for (int k = 0; k < 10'080; ++k) {
    rows.time_us.push_back(std::llround(k * 1e6 / 3.0));
    rows.value.push_back(k);
  }
  const double interval_s = usual_interval_s(rows);
  const Samples samples = align(rows, {0, interval_s, rows.value.size()}, Hold::sample);
  EXPECT_EQ(samples, rows.value);
}

TEST(Grid, UsualIntervalIgnoresGapsAndRepeats) {
  EXPECT_DOUBLE_EQ(usual_interval_s(rows_at({0, 10, 10, 20, 500, 510, 520})), 10.0);
  EXPECT_EQ(usual_interval_s(rows_at({5})), 0.0);
  EXPECT_EQ(usual_interval_s(rows_at({5, 5})), 0.0);
}

TEST(Grid, RepeatedTimesAreCounted) {
  EXPECT_EQ(count_repeated_times(rows_at({0, 10, 10, 10, 20})), 2U);
}

TEST(Grid, DifferencesOfTimesDoNotOverflow) {
  EXPECT_EQ(elapsed_us(3, 10), 7.0);
  EXPECT_EQ(elapsed_us(10, 3), -7.0);
  EXPECT_EQ(elapsed_us(kEarliest, kLatest), std::ldexp(1.0, 64));
  EXPECT_EQ(elapsed_us(kLatest, kEarliest), -std::ldexp(1.0, 64));
}

TEST(Grid, MovedTimesStopAtTheEndsOfTheirType) {
  EXPECT_EQ(moved_us(10, -7.4), 3);
  EXPECT_EQ(moved_us(kLatest - 5, 4.0), kLatest - 1);
  EXPECT_EQ(moved_us(kLatest - 5, 6.0), kLatest);
  EXPECT_EQ(moved_us(kEarliest + 5, -6.0), kEarliest);
  EXPECT_EQ(moved_us(kLatest, -std::ldexp(1.0, 63)), -1);
  EXPECT_EQ(moved_us(kLatest, -std::ldexp(1.0, 64)), kEarliest);
}

TEST(Grid, RowsAtBothEndsOfTimeAreAligned) {
  const RawSeries rows{{kEarliest, 0, kLatest}, {1.0, 2.0, 3.0}};
  const Grid grid{0, 1.0, 2};
  EXPECT_EQ(align(rows, grid, Hold::sample)[0], 2.0);
  EXPECT_EQ(align(rows, grid, Hold::step), (Samples{2.0, 2.0}));
  EXPECT_GT(usual_interval_s({{kEarliest, kLatest}, {1.0, 2.0}}), 1.8e13);
}

TEST(Grid, TimesOfSlots) {
  const Grid grid{5 * kSecond, 0.5, 3};
  EXPECT_EQ(grid.time_us(2), 6 * kSecond);
}

}  // namespace
}  // namespace loopscope::core::signal
