#include "daemon/service/slot.hpp"

#include <gmock/gmock.h>
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

TEST(Slot, MissedOnesAreMadeUpForOldestFirst) {
  EXPECT_EQ(slot_to_analyse(9 * kHour, std::nullopt, 3600.0, 6), 9 * kHour);
  EXPECT_EQ(slot_to_analyse(9 * kHour, 8 * kHour, 3600.0, 6), 9 * kHour);
  EXPECT_EQ(slot_to_analyse(9 * kHour, 5 * kHour, 3600.0, 6), 6 * kHour);
  EXPECT_EQ(slot_to_analyse(9 * kHour, 9 * kHour, 3600.0, 6), 9 * kHour);
  EXPECT_EQ(slot_to_analyse(9 * kHour, 10 * kHour, 3600.0, 6), 9 * kHour)
      << "a clock that went back";
}

TEST(Slot, NoneIsMadeUpForThatIsTooOld) {
  EXPECT_EQ(slot_to_analyse(9 * kHour, 1 * kHour, 3600.0, 6), 3 * kHour);
  EXPECT_EQ(slot_to_analyse(9 * kHour, 1 * kHour, 3600.0, 0), 9 * kHour);
}

TEST(Slot, AfterAChangeOfPeriodTheyLieOnTheNewGrid) {
  EXPECT_EQ(slot_to_analyse(9 * kHour, 6 * kHour + 600 * kSecond, 3600.0, 6), 7 * kHour);
}

TEST(Slot, EarlierOnesBeginWithTheLastThatWasCompleted) {
  using testing::ElementsAre;
  EXPECT_THAT(earlier_slots(5 * kHour, 4 * kHour, 3600.0, 2), ElementsAre(4 * kHour, 3 * kHour));
  EXPECT_THAT(earlier_slots(5 * kHour, 1 * kHour, 3600.0, 2), ElementsAre(1 * kHour, 0))
      << "the monitor stood still for a while";
  EXPECT_THAT(earlier_slots(5 * kHour, 5 * kHour, 3600.0, 1), ElementsAre(4 * kHour))
      << "the same slot is looked at again";
  EXPECT_THAT(earlier_slots(5 * kHour, std::nullopt, 3600.0, 1), ElementsAre(4 * kHour));
  EXPECT_THAT(earlier_slots(5 * kHour, 4 * kHour, 3600.0, 0), testing::IsEmpty());
}

TEST(Slot, PausesDoubleUpToSixHours) {
  EXPECT_EQ(retry_pause_s(0), 60.0);
  EXPECT_EQ(retry_pause_s(3), 480.0);
  EXPECT_EQ(retry_pause_s(1000), 6.0 * 3600.0);
}

}  // namespace
}  // namespace loopscope::daemon
