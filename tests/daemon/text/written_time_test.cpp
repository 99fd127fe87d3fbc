#include "daemon/text/written_time.hpp"

#include <gtest/gtest.h>

#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

/// Microseconds UTC, where the clock is that of UTC if nothing is said; -1 for what is no time.
std::int64_t time_of(std::string_view text, DateOrder order) {
  const auto time = parse_time(text, order);
  return time ? time->clock_us - time->offset_us.value_or(0) : -1;
}

TEST(WrittenTime, DatesOfSpreadsheets) {
  for (const char* text :
       {"01.03.2026 12:00:00", "1.3.2026 12:00", "01/03/2026 12:00:00", "01-03-2026T12:00:00",
        "2026/03/01 12:00", "2026.3.1 12:00:00,000", "01.03.2026 12:00:00 PM",
        "01.03.2026 12:00 pm", "01.03.2026 13:00:00+01:00"}) {
    EXPECT_EQ(time_of(text, DateOrder::day_first), kNoon_us) << text;
  }
  for (const char* text :
       {"03/01/2026 12:00:00", "3/1/2026 12:00:00 PM", "03.01.2026 12:00", "2026-03-01 12:00"}) {
    EXPECT_EQ(time_of(text, DateOrder::month_first), kNoon_us) << text;
  }
  EXPECT_EQ(time_of("01.03.2026 12:00:00,25", DateOrder::day_first), kNoon_us + 250'000);
  EXPECT_EQ(time_of("01.03.2026", DateOrder::day_first), kNoon_us - 43'200'000'000);
  EXPECT_EQ(time_of("3/1/2026 12:30:00 AM", DateOrder::month_first), kNoon_us - 41'400'000'000);
  EXPECT_EQ(time_of("3/1/2026 1:00 PM", DateOrder::month_first), kNoon_us + 3'600'000'000);
}

TEST(WrittenTime, DatesOfSpreadsheetsThatAreNone) {
  for (const char* text :
       {"", "01.03.26 12:00", "01.03/2026 12:00", "31.02.2026", "13.13.2026", "01.03.2026 24:00",
        "01.03.2026 13:00 PM", "01.03.2026 0:00 AM", "01.03.2026 12:00 P", "01.03.2026 12:00 xM",
        "2026/03/01/", "001.03.2026", "1.003.2026", "2026.03.2026", "1.3.20266", "46082.5"}) {
    EXPECT_FALSE(parse_time(text, DateOrder::day_first).has_value()) << text;
  }
}

TEST(WrittenTime, OnlyPointsTellDayFromMonth) {
  EXPECT_EQ(date_form("01.03.2026 12:00"), DateForm::dotted);
  EXPECT_EQ(date_form("25/03/2026"), DateForm::ambiguous);
  EXPECT_EQ(date_form("03-01-2026 1:00 PM"), DateForm::ambiguous);
  for (const char* text : {"2026-03-01", "2026/03/01", "noon", "", "1.5", "1.3.26"})
    EXPECT_EQ(date_form(text), DateForm::other) << text;
}

}  // namespace
}  // namespace loopscope::daemon
