#include "storage/historian/merge_series.hpp"

#include <gmock/gmock.h>

namespace loopscope::storage {
namespace {

using core::signal::RawSeries;
using testing::ElementsAre;

RawSeries rows(std::vector<std::int64_t> times, double value) {
  RawSeries series;
  series.value.assign(times.size(), value);
  series.time_us = std::move(times);
  series.unknown_quality = 1;
  return series;
}

const TagRequest kRequest{"a", 10, 50, 100, RowBefore::yes};

TEST(MergeSeries, OnePartIsReturnedAsItIs) {
  EXPECT_THAT(merge_series({rows({20, 30}, 1.0)}, kRequest).time_us, ElementsAre(20, 30));
  EXPECT_TRUE(merge_series({}, kRequest).empty());
}

TEST(MergeSeries, PartsComeInTheOrderOfTimeAndTheLaterIdLast) {
  const RawSeries merged = merge_series({rows({20, 40}, 1.0), rows({30, 40}, 2.0)}, kRequest);
  EXPECT_THAT(merged.time_us, ElementsAre(20, 30, 40, 40));
  EXPECT_THAT(merged.value, ElementsAre(1.0, 2.0, 1.0, 2.0));
  EXPECT_EQ(merged.unknown_quality, 2U);
}

TEST(MergeSeries, TwoSignalsUnderOneNameDoNotBecomeOne) {
  const RawSeries merged =
      merge_series({rows({15, 25, 35, 45}, 1.0), rows({20, 30, 40}, 2.0)}, kRequest);
  EXPECT_THAT(merged.time_us, ElementsAre(15, 20, 30, 40, 45));
}

TEST(MergeSeries, OfTheRowsBeforeTheSpanTheNewestStays) {
  EXPECT_THAT(merge_series({rows({5, 20}, 1.0), rows({8}, 2.0)}, kRequest).time_us,
              ElementsAre(8, 20));
}

TEST(MergeSeries, TheNewestRowsCountWhereTheyAreTooMany) {
  TagRequest few = kRequest;
  few.max_rows = 2;
  EXPECT_THAT(merge_series({rows({5, 20, 30}, 1.0), rows({40}, 2.0)}, few).time_us,
              ElementsAre(30, 40));
}

}  // namespace
}  // namespace loopscope::storage
