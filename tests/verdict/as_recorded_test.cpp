#include "tests/verdict/as_recorded.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace loopscope::tests::verdict {
namespace {

using core::diagnosis::VerdictCode;

/// NaN = missing is the same as missing.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) { return x == y || (x != x && y != y); });
}

TEST(AsRecorded, ASeedIsARecord) {
  for (const std::uint64_t seed : {1U, 17U, 400U}) {
    const LabelledRecord first = draw_record(seed);
    const LabelledRecord second = draw_record(seed);
    EXPECT_TRUE(same(first.window.pv, second.window.pv));
    EXPECT_TRUE(same(first.window.op, second.window.op));
    EXPECT_EQ(first.truth.causes, second.truth.causes);
    EXPECT_FALSE(same(first.window.pv, draw_record(seed + 1).window.pv));
  }
}

TEST(AsRecorded, RecordsAreAsPlantsKeepThemAndEveryCauseComesUp) {
  std::set<VerdictCode> causes;
  int healthy = 0, centred = 0, without_range = 0;
  constexpr int kRecords = 250;
  for (std::uint64_t seed = 0; seed < std::uint64_t{kRecords}; ++seed) {
    const LabelledRecord record = draw_record(seed);
    const core::signal::LoopWindow& window = record.window;
    EXPECT_GE(window.size(), 200U);
    EXPECT_LE(window.size(), 4096U);
    EXPECT_GE(window.sample_interval_s, 0.1);
    EXPECT_LE(window.sample_interval_s, 60.0);
    for (const auto* series : {&window.sp, &window.op, &window.mv})
      EXPECT_TRUE(series->empty() || series->size() == window.size()) << "seed " << seed;
    EXPECT_TRUE(!record.facts.pv_span || window.op_range);
    EXPECT_TRUE(!record.truth.causes.contains(VerdictCode::valve_oversized) ||
                record.facts.pv_span);
    for (const VerdictCode code : record.truth.doubtful)
      EXPECT_FALSE(record.truth.causes.contains(code)) << "seed " << seed;
    causes.insert(record.truth.causes.begin(), record.truth.causes.end());
    healthy += record.truth.causes.empty() && record.truth.doubtful.empty() ? 1 : 0;
    centred += !window.sp.empty() && std::abs(window.sp.front()) < 20.0 ? 1 : 0;
    without_range += window.op_range ? 0 : 1;
  }
  EXPECT_GE(causes.size(), 11U) << "all but healthy; the oversized valve is rare";
  EXPECT_GT(healthy, kRecords / 10);
  EXPECT_GT(centred, kRecords / 20);
  EXPECT_GT(without_range, kRecords / 5);
}

}  // namespace
}  // namespace loopscope::tests::verdict
