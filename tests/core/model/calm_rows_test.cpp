#include "core/model/calm_rows.hpp"

#include <gtest/gtest.h>

#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kWindow;

Rows rows_of() {
  return make_loop_data(tests::white_noise(kWindow, 1), tests::stepping_op(kWindow, 2), 1.0).rows;
}

bool holds(const std::vector<Range>& rows, std::size_t at) {
  for (const Range& range : rows) {
    if (at >= range.first && at < range.end) return true;
  }
  return false;
}

TEST(CalmRows, GaussianNoiseIsCalm) {
  const Rows rows = rows_of();
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Fit fit;
    fit.innovations = tests::white_noise(kWindow, seed, 3.7);
    EXPECT_EQ(calm_rows(rows, fit).fit_count(), rows.fit_count());
  }
}

TEST(CalmRows, GrossErrorsAndWhatFollowsThemGo) {
  const Rows rows = rows_of();
  const std::size_t at = rows.fit[10].first + 10;
  Fit fit;
  fit.innovations = tests::white_noise(kWindow, 1);
  fit.innovations[at] = -12.0;
  const Rows calm = calm_rows(rows, fit);
  EXPECT_LT(calm.fit_count(), rows.fit_count());
  EXPECT_GT(calm.fit_count() + 30, rows.fit_count());
  EXPECT_FALSE(holds(calm.fit, at));
  EXPECT_FALSE(holds(calm.fit, at + 1));
  EXPECT_EQ(calm.score_count(), rows.score_count());
}

TEST(CalmRows, WhatIsLeftWasThereBefore) {
  const Rows rows = rows_of();
  Fit fit;
  fit.innovations = tests::white_noise(kWindow, 1);
  for (std::size_t k = 0; k < kWindow; k += 97) fit.innovations[k] = 50.0;
  const Rows calm = calm_rows(rows, fit);
  std::size_t end = 0;
  for (const Range& range : calm.fit) {
    EXPECT_LT(range.first, range.end);
    EXPECT_GE(range.first, end);
    end = range.end;
    for (std::size_t k = range.first; k < range.end; ++k) {
      EXPECT_TRUE(holds(rows.fit, k));
      EXPECT_LE(std::abs(fit.innovations[k]), 50.0 / 2);
    }
  }
}

/// Robust: a tenth of the errors being gross does not hide them.
TEST(CalmRows, ScalesWithTheErrors) {
  const Rows rows = rows_of();
  Fit small, large;
  small.innovations = tests::white_noise(kWindow, 1);
  for (std::size_t k = 0; k < kWindow; k += 50) small.innovations[k] = 20.0;
  large.innovations = tests::scaled(small.innovations, 1e6);
  EXPECT_EQ(calm_rows(rows, small).fit_count(), calm_rows(rows, large).fit_count());
  EXPECT_LT(calm_rows(rows, small).fit_count(), rows.fit_count());
}

TEST(CalmRows, NoRowsStayNoRows) {
  Fit fit;
  EXPECT_EQ(calm_rows({}, fit).fit_count(), 0U);
}

}  // namespace
}  // namespace loopscope::core::model
