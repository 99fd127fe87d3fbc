#include "daemon/text/time_zone.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>

#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(TimeZone, UtcIsTheDefaultAndNeedsNoDatabase) {
  const TimeZone utc;
  EXPECT_TRUE(utc.is_utc());
  EXPECT_TRUE(TimeZone("UTC").is_utc());
  EXPECT_EQ(utc.name(), "UTC");
  EXPECT_EQ(utc.clock_us(kNoon_us), kNoon_us);
  EXPECT_EQ(utc.period_at(kNoon_us).words, "UTC");
  EXPECT_EQ(utc.periods(0, kNoon_us).size(), 1U);
  EXPECT_THAT(utc.moments_of(kNoon_us).times_us, ElementsAre(kNoon_us));
}

TEST(TimeZone, OffsetsOfHalfAnHour) {
  const TimeZone kolkata("Asia/Kolkata");
  EXPECT_EQ(kolkata.clock_us(kNoon_us), kNoon_us + 5 * kHour_us + kHour_us / 2);
  EXPECT_EQ(kolkata.period_at(kNoon_us).words, "IST");
}

TEST(TimeZone, AZoneWithoutLettersSaysItsOffset) {
  EXPECT_EQ(TimeZone("Asia/Dubai").period_at(kNoon_us).words, "UTC+04");
}

TEST(TimeZone, PeriodsMeetAtTheChangesOfTheClock) {
  const TimeZone berlin("Europe/Berlin");
  const auto periods = berlin.periods(kBerlinForward_us - 1, kBerlinBack_us);
  ASSERT_EQ(periods.size(), 3U);
  EXPECT_EQ(periods[0].words, "CET");
  EXPECT_EQ(periods[0].end_us, kBerlinForward_us);
  EXPECT_EQ(periods[1].words, "CEST");
  EXPECT_EQ(periods[1].begin_us, kBerlinForward_us);
  EXPECT_EQ(periods[1].offset_us, 2 * kHour_us);
  EXPECT_EQ(periods[1].end_us, kBerlinBack_us);
  EXPECT_EQ(periods[2].words, "CET");
  EXPECT_EQ(berlin.periods(kBerlinForward_us, kBerlinBack_us - 1).size(), 1U);
}

TEST(TimeZone, ReadingsOfTheClockAreOneMomentOrNoneOrTwo) {
  const TimeZone berlin("Europe/Berlin");
  EXPECT_THAT(berlin.moments_of(kNoon_us + kHour_us).times_us, ElementsAre(kNoon_us));
  const auto skipped = berlin.moments_of(kBerlinForward_us + 3 * kHour_us / 2);  // 02:30
  EXPECT_THAT(skipped.times_us, IsEmpty());
  EXPECT_EQ(skipped.change_us, kBerlinForward_us);
  const auto twice = berlin.moments_of(kBerlinBack_us + 3 * kHour_us / 2);  // 02:30
  EXPECT_THAT(twice.times_us,
              ElementsAre(kBerlinBack_us - kHour_us / 2, kBerlinBack_us + kHour_us / 2));
  EXPECT_EQ(twice.change_us, kBerlinBack_us);
  // The first moment behind a change is one alone, the last one before it too.
  EXPECT_THAT(berlin.moments_of(kBerlinForward_us + 2 * kHour_us).times_us,
              ElementsAre(kBerlinForward_us));
  EXPECT_THAT(berlin.moments_of(kBerlinBack_us + 2 * kHour_us).times_us,
              ElementsAre(kBerlinBack_us + kHour_us));
}

TEST(TimeZone, TheDatabaseReachesTwentyThirtySeven) {
  constexpr std::int64_t kSummer_us = 2'130'000'000'000'000;  // 2037-07-01
  EXPECT_EQ(TimeZone("Europe/Berlin").period_at(kSummer_us).words, "CEST");
}

TEST(TimeZone, AnyOtherNameIsRefused) {
  EXPECT_THROW(TimeZone("Europe/Nowhere"), std::runtime_error);
}

}  // namespace
}  // namespace loopscope::daemon
