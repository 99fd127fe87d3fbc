#include "daemon/text/time_text.hpp"

#include <gtest/gtest.h>

#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

TEST(TimeText, Utc) {
  EXPECT_EQ(format_time(kNoon_us), "2026-03-01T12:00:00Z");
  EXPECT_EQ(format_time(kNoon_us + 1), "2026-03-01T12:00:00.000001Z");
  EXPECT_EQ(second_in_zone(kNoon_us + 999'999, {}), "2026-03-01T12:00:00Z");
  EXPECT_EQ(format_time(kNoon_us, TimeZone("UTC")), "2026-03-01T12:00:00Z");
  EXPECT_EQ(minute_in_zone(kNoon_us + 59 * kSecond_us, {}), "2026-03-01 12:00 UTC");
  EXPECT_EQ(minute_below_zone(kNoon_us, {}), "2026-03-01 12:00");
  EXPECT_EQ(minute_in_zone(-1, {}), "1969-12-31 23:59 UTC");
  EXPECT_EQ(day_in_zone(kNoon_us, {}), "2026-03-01");
}

TEST(TimeText, OffsetsOfHalfAnHour) {
  const TimeZone kolkata("Asia/Kolkata");
  EXPECT_EQ(format_time(kNoon_us, kolkata), "2026-03-01T17:30:00+05:30");
  EXPECT_EQ(minute_in_zone(kNoon_us, kolkata), "2026-03-01 17:30 IST");
  EXPECT_EQ(minute_below_zone(kNoon_us, kolkata), "2026-03-01 17:30 IST");
  EXPECT_EQ(day_in_zone(kNoon_us + 7 * kHour_us, kolkata), "2026-03-02");
  EXPECT_EQ(format_time(kNoon_us, TimeZone("America/St_Johns")), "2026-03-01T08:30:00-03:30");
}

// No two times are told alike.
TEST(TimeText, TheClockOfBerlinOverBothChanges) {
  const TimeZone berlin("Europe/Berlin");
  EXPECT_EQ(minute_in_zone(kBerlinForward_us - kMinute_us, berlin), "2026-03-29 01:59 CET");
  EXPECT_EQ(minute_in_zone(kBerlinForward_us, berlin), "2026-03-29 03:00 CEST");
  EXPECT_EQ(minute_in_zone(kBerlinBack_us - kMinute_us, berlin), "2026-10-25 02:59 CEST");
  EXPECT_EQ(minute_in_zone(kBerlinBack_us, berlin), "2026-10-25 02:00 CET");
  EXPECT_EQ(format_time(kBerlinBack_us - kMinute_us, berlin), "2026-10-25T02:59:00+02:00");
  EXPECT_EQ(format_time(kBerlinBack_us + kSecond_us / 2, berlin),
            "2026-10-25T02:00:00.500000+01:00");
  EXPECT_EQ(minute_below_zone(kBerlinBack_us, berlin), "2026-10-25 02:00 CET");
}

TEST(TimeText, BeforeStandardTimesUtcIsSaid) {
  EXPECT_EQ(format_time(-3'000'000'000'000'000, TimeZone("Europe/Berlin")), "1874-12-07T18:40:00Z");
}

TEST(TimeText, SentencesOfTheResultsAreToldInTheZone) {
  const TimeZone berlin("Europe/Berlin");
  const std::string sentence =
      "Wait: 512 samples will be there at 2026-10-25 00:59 UTC, or 2026-10-25 01:00 UTC.";
  EXPECT_EQ(with_times_in_zone(sentence, {}), sentence);
  EXPECT_EQ(with_times_in_zone(sentence, berlin),
            "Wait: 512 samples will be there at 2026-10-25 02:59 CEST, or 2026-10-25 02:00 CET.");
  for (const char* other : {"", "UTC", " UTC", "x UTC", "2026-13-01 12:00 UTC", "12:00 UTC"})
    EXPECT_EQ(with_times_in_zone(other, berlin), other);
}

}  // namespace
}  // namespace loopscope::daemon
