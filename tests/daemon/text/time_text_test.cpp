#include "daemon/text/time_text.hpp"

#include <gtest/gtest.h>

#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

TEST(TimeText, SpellingsOfOneInstant) {
  for (const char* text :
       {"2026-03-01T12:00:00Z", "2026-03-01 12:00:00", "2026-03-01T12:00:00",
        "2026-03-01T13:00:00+01:00", "2026-03-01 07:00:00-0500", "2026-03-01T12:00Z",
        "2026-03-01T12:00:00.000Z", "2026-03-01T12:00", "2026-3-1 12:00", "2026-03-01T13:00+01"}) {
    EXPECT_EQ(parse_time(text), kNoon_us) << text;
  }
}

TEST(TimeText, FractionsOfASecond) {
  EXPECT_EQ(parse_time("2026-03-01T12:00:00.25Z"), kNoon_us + 250'000);
}

TEST(TimeText, AnythingElseIsNoTime) {
  for (const char* text :
       {"", "noon", "2026-13-01T00:00:00Z", "2026-03-01T25:00:00Z", "2026-03-01T12:00:00Z tail",
        "12:00:00", "2026-0-10-25 02:30", "2026-03-01T12", "2026-03-01T12:", "2026-03-01T12:00:",
        "2026-03-01T12:00:00.", "2026-03-01T12:00:60Z", "2026-02-29", "2026-03-01Z",
        "2026-03-01T12:00+", "2026-03-01T12:00+01:", "2026-03-01T12:00:00.1234567"}) {
    EXPECT_FALSE(parse_time(text).has_value()) << text;
  }
}

TEST(TimeText, OnlyYearsThatTheDatabaseHolds) {
  EXPECT_TRUE(parse_time("0001-01-01T00:00:00Z").has_value());
  EXPECT_TRUE(parse_time("9999-12-31T23:59:59.999999Z").has_value());
  for (const char* text : {"0000-12-31T23:59:59Z", "0001-01-01T00:00:00+01:00", "-0044-03-15",
                           "9999-12-31T23:59:59-01:00", "10000-01-01T00:00:00Z"}) {
    EXPECT_FALSE(parse_time(text).has_value()) << text;
  }
}

TEST(TimeText, ZonesAreNoticed) {
  for (const char* text : {"2026-03-01T12:00:00Z", "2026-03-01 13:00:00+01:00",
                           "2026-03-01T07:00:00-0500", "2026-03-01T12:00Z"}) {
    EXPECT_TRUE(names_zone(text)) << text;
  }
  for (const char* text : {"2026-03-01T12:00:00", "2026-03-01 12:00:00.25", "2026-03-01"}) {
    EXPECT_FALSE(names_zone(text)) << text;
  }
}

TEST(TimeText, FormattedTimesReadBack) {
  for (const std::int64_t time :
       {kNoon_us, kNoon_us + 1, std::int64_t{0}, std::int64_t{-1'500'000}}) {
    EXPECT_EQ(parse_time(format_time(time)), time) << format_time(time);
  }
  EXPECT_EQ(format_time(kNoon_us), "2026-03-01T12:00:00Z");
}

}  // namespace
}  // namespace loopscope::daemon
