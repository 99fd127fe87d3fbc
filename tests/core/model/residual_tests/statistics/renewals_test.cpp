#include "core/model/residual_tests/statistics/renewals.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "tests/core/model/residual_tests/loops.hpp"

namespace loopscope::core::model {
namespace {

using tests::Series;

TEST(Renewals, RunsAreCountedBetweenKnownChanges) {
  const double missing = std::numeric_limits<double>::quiet_NaN();
  const std::vector<FlatRun> runs =
      complete_runs(Series{1, 1, 2, 2, 2, 3, missing, 3, 4, 4, 5}, 0.0);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].begin, 2U);
  EXPECT_EQ(runs[0].samples, 3U);
  EXPECT_EQ(runs[1].begin, 8U);
  EXPECT_EQ(runs[1].samples, 2U);
}

TEST(Renewals, TheClockIsTheLongestThatFits) {
  std::vector<FlatRun> runs;
  for (std::size_t at = 7; at < 4000; at += 12) runs.push_back({at, 12});
  runs[20].samples = 24;
  const Clock clock = find_clock(runs);
  EXPECT_EQ(clock.period_samples, 12U);
  EXPECT_LT(clock.p, 1e-100);
}

TEST(Renewals, ChanceHasNoClock) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Series draw = tests::white(tests::White::gaussian, 400, seed);
    Series signal = draw;
    for (std::size_t k = 1; k < signal.size(); ++k)
      if (draw[k] > 0.0) signal[k] = signal[k - 1];
    found += find_clock(complete_runs(signal, 0.0)).p <= 0.05 ? 1 : 0;
  }
  EXPECT_LE(found, 15);
}

}  // namespace
}  // namespace loopscope::core::model
