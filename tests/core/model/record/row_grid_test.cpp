#include "core/model/record/row_grid.hpp"

#include <gtest/gtest.h>

namespace loopscope::core::model {
namespace {

const std::vector<double> kCounting{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};

TEST(RowGrid, CountsRowsAndFindsTheirSamples) {
  const RowGrid grid{3, 1};
  EXPECT_EQ(grid.rows_in(0), 0U);
  EXPECT_EQ(grid.rows_in(1), 0U);
  EXPECT_EQ(grid.rows_in(2), 1U);
  EXPECT_EQ(grid.rows_in(4), 1U);
  EXPECT_EQ(grid.rows_in(8), 3U);
  for (std::size_t row = 0; row < 5; ++row) EXPECT_EQ(grid.row_from(grid.sample_of(row)), row);
  EXPECT_EQ(grid.row_from(0), 0U);
  EXPECT_EQ(grid.row_from(2), 1U);
  EXPECT_EQ(grid.row_from(5), 2U);
}

TEST(RowGrid, PicksTheRows) {
  const RowGrid grid{3, 1};
  EXPECT_EQ(at_rows(grid, kCounting), (std::vector{1.0, 4.0, 7.0}));
  EXPECT_EQ(at_rows(grid, kCounting, 2), (std::vector{0.0, 2.0, 5.0}));
  std::vector<double> kept = kCounting;
  keep_rows(grid, kept);
  EXPECT_EQ(kept, at_rows(grid, kCounting));
}

TEST(RowGrid, EverySampleIsTheSignal) {
  const RowGrid grid;
  EXPECT_TRUE(grid.every_sample());
  EXPECT_EQ(grid.rows_in(8), 8U);
  EXPECT_EQ(grid.row_from(5), 5U);
  EXPECT_EQ(at_rows(grid, kCounting), kCounting);
  std::vector<double> kept = kCounting;
  keep_rows(grid, kept);
  EXPECT_EQ(kept, kCounting);
}

}  // namespace
}  // namespace loopscope::core::model
