#include "core/model/record/loop_data.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

#include "tests/core/model/model_records.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::model {
namespace {

using loopscope::tests::kNaN;
using loopscope::tests::kWindow;

LoopData full_record() {
  return make_loop_data(tests::white_noise(kWindow, 1), tests::stepping_op(kWindow, 2), 1.0);
}

std::vector<int> seen(const std::vector<Range>& rows, std::size_t size) {
  std::vector<int> count(size, 0);
  for (const Range& range : rows) {
    for (std::size_t k = range.first; k < range.end; ++k) ++count[k];
  }
  return count;
}

/// Samples that neither kind of row holds are between the two: the guard.
std::size_t shortest_guard(const Rows& rows) {
  std::vector<Range> all = rows.fit;
  all.insert(all.end(), rows.score.begin(), rows.score.end());
  std::ranges::sort(all, {}, &Range::first);
  std::size_t shortest = kWindow;
  for (std::size_t i = 1; i < all.size(); ++i) {
    shortest = std::min(shortest, all[i].first - all[i - 1].end);
  }
  return shortest;
}

TEST(LoopData, NoSampleIsFittedAndScored) {
  const LoopData data = full_record();
  const auto fit = seen(data.rows.fit, kWindow);
  const auto score = seen(data.rows.score, kWindow);
  for (std::size_t k = 0; k < kWindow; ++k) EXPECT_LE(fit[k] + score[k], 1) << k;
  EXPECT_GE(shortest_guard(data.rows), 1U);
}

TEST(LoopData, BlocksAlternateAndShareTheRecord) {
  const LoopData data = full_record();
  std::vector<std::pair<std::size_t, bool>> blocks;
  for (const Range& range : data.rows.fit) blocks.emplace_back(range.first, true);
  for (const Range& range : data.rows.score) blocks.emplace_back(range.first, false);
  std::ranges::sort(blocks);
  for (std::size_t i = 1; i < blocks.size(); ++i) {
    EXPECT_NE(blocks[i].second, blocks[i - 1].second) << blocks[i].first;
  }
  const auto fit = static_cast<double>(data.rows.fit_count());
  const auto score = static_cast<double>(data.rows.score_count());
  EXPECT_NEAR(fit / (fit + score), 0.5, 0.05);
  EXPECT_GT(fit + score, 0.8 * kWindow);
}

TEST(LoopData, CountsAreTheSumsOfTheRanges) {
  const LoopData data = full_record();
  const auto fit = seen(data.rows.fit, kWindow);
  EXPECT_EQ(data.rows.fit_count(), static_cast<std::size_t>(std::ranges::count(fit, 1)));
}

/// Setpoint moves and cycles that come at regular times have to fall to both kinds alike.
TEST(LoopData, RegularEventsFallToBothKinds) {
  const LoopData data = full_record();
  const auto fit = seen(data.rows.fit, kWindow);
  const auto score = seen(data.rows.score, kWindow);
  for (std::size_t period = 20; period <= 200; period += 7) {
    int fitted = 0, scored = 0;
    for (std::size_t k = 60; k < kWindow; k += period) fitted += fit[k], scored += score[k];
    EXPECT_GT(std::min(fitted, scored), std::max(fitted, scored) / 5) << period;
  }
}

TEST(LoopData, DistancesFromTheMeanInStandardDeviations) {
  const tests::Series pv =
      tests::sum(tests::scaled(tests::white_noise(1000, 1), 3.0), tests::Series(1000, 70.0));
  const tests::Series op = tests::stepping_op(1000, 2);
  const LoopData data = make_loop_data(pv, op, 5.0);
  EXPECT_EQ(data.sample_interval_s, 5.0);
  EXPECT_NEAR(tests::mean(data.pv), 0.0, 1e-9);
  EXPECT_NEAR(tests::mean(data.op), 0.0, 1e-9);
  for (std::size_t k = 0; k < pv.size(); ++k) {
    EXPECT_NEAR(data.pv[k] * data.pv_scale + data.pv_mean, pv[k], 1e-9);
    EXPECT_NEAR(data.op[k] + data.op_mean, op[k], 1e-9);
  }
  double square = 0.0;
  for (const double value : data.pv) square += value * value / 1000.0;
  EXPECT_NEAR(square, 1.0, 1e-9);
}

TEST(LoopData, GapsAreBridgedByStraightLinesAndInNoRow) {
  tests::Series pv = tests::white_noise(kWindow, 1), op = tests::stepping_op(kWindow, 2);
  for (std::size_t k = 1000; k < 1011; ++k) pv[k] = kNaN;
  for (std::size_t k = 2000; k < 2300; ++k) op[k] = kNaN;
  const LoopData data = make_loop_data(pv, op, 1.0);
  for (std::size_t k = 1000; k < 1011; ++k) {
    const double share = static_cast<double>(k - 999) / 12.0;
    EXPECT_NEAR(data.pv[k], data.pv[999] + share * (data.pv[1011] - data.pv[999]), 1e-12);
  }
  for (const auto* rows : {&data.rows.fit, &data.rows.score}) {
    for (const Range& range : *rows) {
      for (std::size_t k = range.first; k < range.end; ++k) {
        EXPECT_FALSE(std::isnan(pv[k]) || std::isnan(op[k])) << k;
      }
    }
  }
}

TEST(LoopData, MissingEndsHoldTheNearestValue) {
  tests::Series pv = tests::white_noise(600, 1);
  for (std::size_t k = 0; k < 50; ++k) pv[k] = pv[599 - k] = kNaN;
  const LoopData data = make_loop_data(pv, tests::stepping_op(600, 2), 1.0);
  EXPECT_THAT(data.pv, testing::Each(testing::Truly([](double v) { return std::isfinite(v); })));
  EXPECT_EQ(data.pv.front(), data.pv[50]);
  EXPECT_EQ(data.pv.back(), data.pv[549]);
}

TEST(LoopData, ShortRecordsHaveBothKindsOfRows) {
  for (std::size_t samples : {400U, 500U, 600U}) {
    const LoopData data =
        make_loop_data(tests::white_noise(samples, 1), tests::stepping_op(samples, 2), 1.0);
    EXPECT_GT(data.rows.fit_count(), samples / 4);
    EXPECT_GT(data.rows.score_count(), samples / 4);
  }
}

TEST(LoopData, TheMirrorOfTheMirrorIsTheRecord) {
  const LoopData data = full_record();
  const LoopData once = on_other_fold(data);
  EXPECT_EQ(once.rows.fit_count(), data.rows.score_count());
  EXPECT_EQ(seen(once.rows.score, kWindow), seen(data.rows.fit, kWindow));
  EXPECT_EQ(seen(on_other_fold(once).rows.fit, kWindow), seen(data.rows.fit, kWindow));
}

TEST(LoopData, SeenByBothAddsTheWindowToBothAndNothingElse) {
  const LoopData data = full_record();
  for (const std::size_t at : {50U, 777U, 2048U, 4050U}) {
    const Rows rows = seen_by_both(data.rows, at, 16);
    for (const auto& [now, before] :
         {std::pair{rows.fit, data.rows.fit}, std::pair{rows.score, data.rows.score}}) {
      const auto after = seen(now, kWindow), earlier = seen(before, kWindow);
      for (std::size_t k = 0; k < kWindow; ++k) {
        EXPECT_EQ(after[k], k >= at && k < at + 16 ? 1 : earlier[k]) << k;
      }
    }
  }
}

/// Once each, also where both kinds have it already.
TEST(LoopData, SeenWholeFitsTheRowsOfBothKinds) {
  LoopData data = full_record();
  data.rows = seen_by_both(data.rows, 1000, 40);
  const LoopData whole = seen_whole(data);
  const auto fit = seen(data.rows.fit, kWindow);
  const auto score = seen(data.rows.score, kWindow);
  const auto both = seen(whole.rows.fit, kWindow);
  for (std::size_t k = 0; k < kWindow; ++k) EXPECT_EQ(both[k], std::max(fit[k], score[k])) << k;
  EXPECT_EQ(whole.rows.score_count(), data.rows.score_count());
}

TEST(LoopData, SeenByBothStaysWithinTheRecord) {
  const LoopData data = full_record();
  const Rows rows = seen_by_both(data.rows, kWindow + 100, 16);
  for (const auto* kind : {&rows.fit, &rows.score}) EXPECT_LE(kind->back().end, kWindow);
  EXPECT_TRUE(seen_by_both(Rows{}, 5, 16).fit.empty());
}

TEST(LoopData, OfAHeldSensorTheRowsAreFewerThanTheSamples) {
  const tests::Series pv = tests::white_noise(kWindow, 1), op = tests::stepping_op(kWindow, 2);
  const RowGrid grid{15, 4};
  const LoopData data = make_loop_data(pv, op, 2.0, grid);
  EXPECT_EQ(data.sample_interval_s, 2.0);
  EXPECT_EQ(data.samples(), kWindow);
  ASSERT_EQ(data.size(), grid.rows_in(kWindow));
  for (std::size_t row = 0; row < data.size(); ++row) {
    EXPECT_NEAR(data.pv[row] * data.pv_scale + data.pv_mean, pv[grid.sample_of(row)], 1e-9);
  }
  EXPECT_NEAR(tests::mean(data.pv), 0.0, 1e-9);
  EXPECT_GE(data.rows.fit_count(), 90U);
  EXPECT_GE(data.rows.score_count(), 90U);
  EXPECT_GE(data.rows.fit.size(), 5U);
  EXPECT_GE(data.rows.score.size(), 5U);
}

TEST(LoopData, ARowThatWaitsForAMissingOpIsNone) {
  tests::Series pv = tests::white_noise(kWindow, 1), op = tests::stepping_op(kWindow, 2);
  const LoopData whole = make_loop_data(pv, op, 1.0, {10, 3});
  op[2004] = kNaN;  // row 200 is at 2003, the next one at 2013
  for (std::size_t k = 1003; k < 1013; ++k) pv[k] = kNaN;
  pv[3000] = kNaN;  // between rows
  const LoopData data = make_loop_data(pv, op, 1.0, {10, 3});
  const auto before = seen(whole.rows.fit, data.size()), after = seen(data.rows.fit, data.size());
  const auto other = seen(whole.rows.score, data.size());
  const auto still = seen(data.rows.score, data.size());
  for (std::size_t row = 0; row < data.size(); ++row) {
    const bool lost = (row >= 100 && row < 112) || (row >= 201 && row < 213);
    EXPECT_EQ(after[row] + still[row], lost ? 0 : before[row] + other[row]) << row;
  }
}

TEST(LoopData, FewRowsWarmUpForLess) {
  EXPECT_EQ(warm_up_rows({}, 300), 40U);
  EXPECT_EQ(warm_up_rows({4, 0}, 1024), 40U);
  EXPECT_LT(warm_up_rows({15, 0}, 273), 30U);
}

}  // namespace
}  // namespace loopscope::core::model
