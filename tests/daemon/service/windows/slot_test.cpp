#include "daemon/service/windows/slot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

TEST(Slot, EndsAreWholePeriods) {
  EXPECT_EQ(floor_to_period(5 * kHour_us + 17, 3600.0), 5 * kHour_us);
  EXPECT_EQ(floor_to_period(5 * kHour_us, 3600.0), 5 * kHour_us);
  EXPECT_EQ(floor_to_period(-1, 3600.0), -kHour_us);
  EXPECT_EQ(floor_to_period(7 * kSecond_us, 2.5), 5 * kSecond_us);
}

TEST(Slot, TheNextLookIsWhenTheNextSlotHasSettled) {
  EXPECT_EQ(next_due(5 * kHour_us, 3600.0, 60.0), 6 * kHour_us + 60 * kSecond_us);
  const std::int64_t due = next_due(5 * kHour_us, 3600.0, 60.0);
  EXPECT_EQ(floor_to_period(due - 60 * kSecond_us, 3600.0), 6 * kHour_us);
}

/// Due at once and before all others, such loops would be all that is ever visited.
TEST(Slot, OldRowsAreNotLookedAtAgainBeforeThePeriodIsOver) {
  const std::int64_t now = 9 * kHour_us + 600 * kSecond_us;
  EXPECT_EQ(next_due_by_rows(5 * kHour_us, now, 3600.0, 60.0), 10 * kHour_us + 60 * kSecond_us);
  EXPECT_EQ(next_due_by_rows(9 * kHour_us, now, 3600.0, 60.0),
            next_due(9 * kHour_us, 3600.0, 60.0));
  EXPECT_EQ(next_due_by_rows(-kHour_us, 9 * kHour_us + 30 * kSecond_us, 3600.0, 60.0),
            9 * kHour_us + 60 * kSecond_us)
      << "the slot of 9 h has not settled";
}

TEST(Slot, MissedOnesAreMadeUpForOldestFirst) {
  EXPECT_EQ(slot_to_analyse(9 * kHour_us, std::nullopt, 3600.0, 6), 9 * kHour_us);
  EXPECT_EQ(slot_to_analyse(9 * kHour_us, 8 * kHour_us, 3600.0, 6), 9 * kHour_us);
  EXPECT_EQ(slot_to_analyse(9 * kHour_us, 5 * kHour_us, 3600.0, 6), 6 * kHour_us);
  EXPECT_EQ(slot_to_analyse(9 * kHour_us, 9 * kHour_us, 3600.0, 6), 9 * kHour_us);
  EXPECT_EQ(slot_to_analyse(9 * kHour_us, 10 * kHour_us, 3600.0, 6), 9 * kHour_us)
      << "a clock that went back";
}

TEST(Slot, NoneIsMadeUpForThatIsTooOld) {
  EXPECT_EQ(slot_to_analyse(9 * kHour_us, 1 * kHour_us, 3600.0, 6), 3 * kHour_us);
  EXPECT_EQ(slot_to_analyse(9 * kHour_us, 1 * kHour_us, 3600.0, 0), 9 * kHour_us);
}

TEST(Slot, AfterAChangeOfPeriodTheyLieOnTheNewGrid) {
  EXPECT_EQ(slot_to_analyse(9 * kHour_us, 6 * kHour_us + 600 * kSecond_us, 3600.0, 6),
            7 * kHour_us);
}

TEST(Slot, EarlierOnesBeginWithTheLastThatWasCompleted) {
  using testing::ElementsAre;
  EXPECT_THAT(earlier_slots(5 * kHour_us, 4 * kHour_us, 3600.0, 2),
              ElementsAre(4 * kHour_us, 3 * kHour_us));
  EXPECT_THAT(earlier_slots(5 * kHour_us, 1 * kHour_us, 3600.0, 2), ElementsAre(1 * kHour_us, 0))
      << "the monitor stood still for a while";
  EXPECT_THAT(earlier_slots(5 * kHour_us, 5 * kHour_us, 3600.0, 1), ElementsAre(4 * kHour_us))
      << "the same slot is looked at again";
  EXPECT_THAT(earlier_slots(5 * kHour_us, std::nullopt, 3600.0, 1), ElementsAre(4 * kHour_us));
  EXPECT_THAT(earlier_slots(5 * kHour_us, 4 * kHour_us, 3600.0, 0), testing::IsEmpty());
}

TEST(Slot, PausesDoubleUpToSixHours) {
  EXPECT_EQ(retry_pause_s(0), 60.0);
  EXPECT_EQ(retry_pause_s(3), 480.0);
  EXPECT_EQ(retry_pause_s(1000), 6.0 * 3600.0);
}

}  // namespace
}  // namespace loopscope::daemon
