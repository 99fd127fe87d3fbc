#include "daemon/service/slot.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kHour = 3600 * kSecond;

TEST(Slot, EndsAreWholePeriods) {
  EXPECT_EQ(floor_to_period(5 * kHour + 17, 3600.0), 5 * kHour);
  EXPECT_EQ(floor_to_period(5 * kHour, 3600.0), 5 * kHour);
  EXPECT_EQ(floor_to_period(-1, 3600.0), -kHour);
  EXPECT_EQ(floor_to_period(7 * kSecond, 2.5), 5 * kSecond);
}

TEST(Slot, TheNextLookIsWhenTheNextSlotHasSettled) {
  EXPECT_EQ(next_due(5 * kHour, 3600.0, 60.0), 6 * kHour + 60 * kSecond);
  const std::int64_t due = next_due(5 * kHour, 3600.0, 60.0);
  EXPECT_EQ(floor_to_period(due - 60 * kSecond, 3600.0), 6 * kHour);
}

TEST(Slot, PausesDoubleUpToSixHours) {
  EXPECT_EQ(retry_pause_s(0), 60.0);
  EXPECT_EQ(retry_pause_s(3), 480.0);
  EXPECT_EQ(retry_pause_s(1000), 6.0 * 3600.0);
}

}  // namespace
}  // namespace loopscope::daemon
