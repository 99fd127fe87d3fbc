#include "storage/historian/native_time.hpp"

#include <bit>
#include <gtest/gtest.h>

namespace loopscope::storage {
namespace {

constexpr std::int64_t kTimeUs = 1'735'689'600'123'456;  // 2025-01-01 00:00:00.123456

TEST(NativeTime, LowerBoundRoundsUpAndUpperBoundDown) {
  EXPECT_EQ(native_bound(TimeKind::epoch_s, kTimeUs, Bound::lower), "1735689601");
  EXPECT_EQ(native_bound(TimeKind::epoch_s, kTimeUs, Bound::upper), "1735689600");
  EXPECT_EQ(native_bound(TimeKind::epoch_ms, kTimeUs, Bound::lower), "1735689600124");
  EXPECT_EQ(native_bound(TimeKind::epoch_ms, kTimeUs, Bound::upper), "1735689600123");
  EXPECT_EQ(native_bound(TimeKind::epoch_us, kTimeUs, Bound::lower), "1735689600123456");
  EXPECT_EQ(native_bound(TimeKind::timestamptz, kTimeUs, Bound::lower),
            "2025-01-01 00:00:00.123456+00");
}

TEST(NativeTime, RoundsTheSameWayBefore1970) {
  EXPECT_EQ(native_bound(TimeKind::epoch_s, -1, Bound::lower), "0");
  EXPECT_EQ(native_bound(TimeKind::epoch_s, -1, Bound::upper), "-1");
  EXPECT_EQ(native_bound(TimeKind::epoch_s, -1'000'000, Bound::lower), "-1");
  EXPECT_EQ(native_bound(TimeKind::epoch_s, -1'000'000, Bound::upper), "-1");
}

TEST(NativeTime, FloatBoundsHoldTheirOwnTime) {
  for (std::int64_t time = kTimeUs; time < kTimeUs + 1000; ++time) {
    const double stored = std::stod(native_text(TimeKind::epoch_s_float, time));
    const std::int64_t read =
        microseconds(TimeKind::epoch_s_float, std::bit_cast<std::uint64_t>(stored));
    EXPECT_EQ(read, time);
    EXPECT_LE(std::stod(native_bound(TimeKind::epoch_s_float, read, Bound::lower)), stored);
    EXPECT_GE(std::stod(native_bound(TimeKind::epoch_s_float, read, Bound::upper)), stored);
  }
}

TEST(NativeTime, ReadsMicroseconds) {
  EXPECT_EQ(microseconds(TimeKind::epoch_s, 5), 5'000'000);
  EXPECT_EQ(microseconds(TimeKind::epoch_ms, static_cast<std::uint64_t>(-5)), -5'000);
  EXPECT_EQ(microseconds(TimeKind::epoch_us, 5), 5);
  EXPECT_EQ(microseconds(TimeKind::timestamptz, 0), 946'684'800'000'000) << "2000-01-01";
}

TEST(NativeTime, EveryBoundIsOneThatTheServerTakes) {
  for (const std::int64_t time : {INT64_MIN, INT64_MAX}) {
    for (const Bound bound : {Bound::lower, Bound::upper}) {
      EXPECT_LE(native_bound(TimeKind::timestamptz, time, bound).size(), 29u);
      EXPECT_LE(native_bound(TimeKind::epoch_s, time, bound).size(), 12u);
    }
  }
}

}  // namespace
}  // namespace loopscope::storage
