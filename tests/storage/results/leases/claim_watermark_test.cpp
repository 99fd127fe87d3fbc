#include "storage/results/leases/claim_watermark.hpp"

#include <gtest/gtest.h>

namespace loopscope::storage {
namespace {

constexpr std::int64_t kMinute_us = 60'000'000;
constexpr std::int64_t kNow_us = 1'767'225'600'000'000;  // 2026-01-01

TEST(ClaimWatermarkTest, RisesWithWhatIsTaken) {
  ClaimWatermark watermark;
  EXPECT_FALSE(watermark.place());
  const ClaimWatermark::Start first = watermark.start(kNow_us);
  EXPECT_EQ(first.place, behind(kNow_us)) << "whoever begins looks back";
  watermark.passed(first, {kNow_us + 5, 7});
  EXPECT_EQ(watermark.start(kNow_us + 9).place, (DuePlace{kNow_us + 5, 7}));
  watermark.passed(first, {kNow_us + 5, 3});
  EXPECT_EQ(watermark.place(), (DuePlace{kNow_us + 5, 7}))
      << "a claim that was slower lowers nothing";
}

TEST(ClaimWatermarkTest, IsLoweredToBeforeWhatWasFound) {
  ClaimWatermark watermark;
  const ClaimWatermark::Start start = watermark.start(kNow_us);
  watermark.lower({kNow_us - 3, 8});
  EXPECT_EQ(watermark.place(), (DuePlace{kNow_us - 3, 7}));
  watermark.passed(start, behind(kNow_us));
  EXPECT_EQ(watermark.place(), (DuePlace{kNow_us - 3, 7}))
      << "the claim under way began above what was found";
  watermark.lower({kNow_us - 1, 1});
  EXPECT_EQ(watermark.place(), (DuePlace{kNow_us - 3, 7})) << "that is behind it";
}

/// Such a watermark is of a clock that was ahead: with it nothing would be claimed until its time
/// came.
TEST(ClaimWatermarkTest, BeginsAnewWhereTheClockWasSetBack) {
  ClaimWatermark watermark;
  static_cast<void>(watermark.start(kNow_us + 30 * kMinute_us));
  EXPECT_EQ(watermark.start(kNow_us).place, behind(kNow_us));
  EXPECT_EQ(watermark.nearest().to, behind(kNow_us));
  EXPECT_EQ(watermark.start(kNow_us - 1000).place, behind(kNow_us))
      << "a transaction that began a little earlier";
}

/// Slices without a gap, wider while they are quick, down to the earliest time.
TEST(ClaimWatermarkTest, LooksThroughAllTimeInSlicesWithoutAGap) {
  ClaimWatermark watermark;
  static_cast<void>(watermark.start(kNow_us));
  const ClaimWatermark::Slice nearest = watermark.nearest();
  EXPECT_EQ(nearest.from_us, kNow_us - kMinute_us);
  watermark.looked_nearest(nearest);
  watermark.lower({kNow_us - kMinute_us / 2, 1});
  std::int64_t down_to_us = nearest.from_us;
  int slices = 0;
  for (bool at_end = false; !at_end; ++slices) {
    const ClaimWatermark::Slice slice = watermark.next();
    EXPECT_EQ(slice.to, behind(down_to_us));
    EXPECT_LT(slice.from_us, down_to_us);
    down_to_us = slice.from_us;
    at_end = watermark.looked(slice, 0.0001);
  }
  EXPECT_EQ(down_to_us, kBeforeAll.due_us);
  EXPECT_LE(slices, 20);
  const std::int64_t lowered_us = kNow_us - kMinute_us / 2;
  EXPECT_EQ(watermark.next().to, behind(lowered_us - kMinute_us)) << "and from the watermark again";
  EXPECT_EQ(watermark.next().from_us, lowered_us - 2 * kMinute_us) << "as narrow as at first";
}

/// A slice of constant cost: twice the dead entries an hour make it half as wide.
TEST(ClaimWatermarkTest, WidthOfASliceFollowsWhatItCosts) {
  for (const double cost_s_per_minute : {1e-4, 1e-3, 1e-2, 1e-1}) {
    ClaimWatermark watermark;
    static_cast<void>(watermark.start(kNow_us));
    double cost_s = 0.0;
    for (int look = 0; look < 50; ++look) {
      const ClaimWatermark::Slice slice = watermark.next();
      const double minutes =
          static_cast<double>(slice.to.due_us - slice.from_us) / static_cast<double>(kMinute_us);
      cost_s = minutes * cost_s_per_minute;
      static_cast<void>(watermark.looked(slice, cost_s));
    }
    EXPECT_LT(cost_s, 0.02) << cost_s_per_minute;
    EXPECT_GT(cost_s, 0.0005) << cost_s_per_minute;
  }
}

/// Loops of a source that is away stay where they are, for hours.
TEST(ClaimWatermarksTest, ClaimsThatLeaveOutSourcesHaveAFloorOfTheirOwn) {
  ClaimWatermarks watermarks;
  ClaimWatermark& all = watermarks.of({});
  all.passed(all.start(kNow_us), behind(kNow_us));
  ClaimWatermark& elsewhere = watermarks.of({"a"});
  EXPECT_EQ(elsewhere.place(), all.place());
  elsewhere.passed(elsewhere.start(kNow_us + kMinute_us), behind(kNow_us + kMinute_us));
  EXPECT_EQ(watermarks.of({"a"}).place(), behind(kNow_us + kMinute_us));
  EXPECT_EQ(watermarks.of({}).place(), behind(kNow_us)) << "its loops are still to be found";
  EXPECT_EQ(watermarks.of({"b"}).place(), behind(kNow_us)) << "and those of a when b is away";
  EXPECT_EQ(watermarks.of({"a"}).place(), behind(kNow_us + kMinute_us)) << "lists may come and go";
  all.passed(all.start(kNow_us + 9 * kMinute_us), behind(kNow_us + 9 * kMinute_us));
  EXPECT_EQ(watermarks.of({"a"}).place(), behind(kNow_us + 9 * kMinute_us));
}

}  // namespace
}  // namespace loopscope::storage
