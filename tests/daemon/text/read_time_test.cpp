#include "daemon/text/read_time.hpp"

#include <gtest/gtest.h>

#include "daemon/text/failure.hpp"
#include "daemon/text/time_text.hpp"
#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

/// In microseconds; -1 for what is no time.
std::int64_t time_of(std::string_view text, const TimeZone& zone = {}) {
  const auto read = read_time(text, zone);
  const auto* time_us = std::get_if<std::int64_t>(&read);
  return time_us == nullptr ? -1 : *time_us;
}

TimeProblem problem_of(std::string_view text, const TimeZone& zone) {
  const auto read = read_time(text, zone);
  const auto* problem = std::get_if<TimeProblem>(&read);
  return problem == nullptr ? TimeProblem{} : *problem;
}

TEST(ReadTime, SpellingsOfOneInstant) {
  for (const char* text :
       {"2026-03-01T12:00:00Z", "2026-03-01 12:00:00", "2026-03-01T12:00:00",
        "2026-03-01T13:00:00+01:00", "2026-03-01 07:00:00-0500", "2026-03-01T12:00Z",
        "2026-03-01T12:00:00.000Z", "2026-03-01T12:00", "2026-3-1 12:00", "2026-03-01T13:00+01"}) {
    EXPECT_EQ(time_of(text), kNoon_us) << text;
  }
}

TEST(ReadTime, FractionsOfASecond) {
  EXPECT_EQ(time_of("2026-03-01T12:00:00.25Z"), kNoon_us + 250'000);
}

TEST(ReadTime, AnythingElseIsNoTime) {
  for (const char* text :
       {"", "noon", "2026-13-01T00:00:00Z", "2026-03-01T25:00:00Z", "2026-03-01T12:00:00Z tail",
        "12:00:00", "2026-0-10-25 02:30", "2026-03-01T12", "2026-03-01T12:", "2026-03-01T12:00:",
        "2026-03-01T12:00:00.", "2026-03-01T12:00:60Z", "2026-02-29", "2026-03-01Z",
        "2026-03-01T12:00+", "2026-03-01T12:00+01:", "2026-03-01T12:00:00.1234567"}) {
    EXPECT_FALSE(parse_time(text).has_value()) << text;
    EXPECT_EQ(problem_of(text, {}).what, "is not a time") << text;
  }
}

TEST(ReadTime, OnlyYearsThatTheDatabaseHolds) {
  EXPECT_TRUE(parse_time("0001-01-01T00:00:00Z").has_value());
  EXPECT_TRUE(parse_time("9999-12-31T23:59:59.999999Z").has_value());
  for (const char* text : {"0000-12-31T23:59:59Z", "0001-01-01T00:00:00+01:00", "-0044-03-15",
                           "9999-12-31T23:59:59-01:00", "10000-01-01T00:00:00Z"}) {
    EXPECT_FALSE(parse_time(text).has_value()) << text;
  }
  EXPECT_EQ(problem_of("0001-01-01T00:00:00", TimeZone("Asia/Kolkata")).what, "is not a time");
}

TEST(ReadTime, OffsetsAreNoticed) {
  for (const char* text : {"2026-03-01T12:00:00Z", "2026-03-01 13:00:00+01:00",
                           "2026-03-01T07:00:00-0500", "2026-03-01T12:00Z"}) {
    EXPECT_TRUE(parse_time(text)->offset_us.has_value()) << text;
  }
  for (const char* text : {"2026-03-01T12:00:00", "2026-03-01 12:00:00.25", "2026-03-01"}) {
    EXPECT_FALSE(parse_time(text)->offset_us.has_value()) << text;
  }
}

TEST(ReadTime, WhatIsShownIsReadBack) {
  for (const char* name : {"UTC", "Asia/Kolkata", "Europe/Berlin", "America/St_Johns"}) {
    const TimeZone zone(name);
    for (const std::int64_t time :
         {kNoon_us, kNoon_us + 1, std::int64_t{0}, std::int64_t{-1'500'000},
          std::int64_t{1'792'889'999'000'000}, std::int64_t{1'792'890'000'000'000}}) {
      EXPECT_EQ(time_of(format_time(time, zone)), time) << format_time(time, zone);
    }
  }
}

TEST(ReadTime, WithoutAnOffsetTheClockOfThePlantIsMeant) {
  EXPECT_EQ(time_of("2026-03-01 17:30", TimeZone("Asia/Kolkata")), kNoon_us);
  EXPECT_EQ(time_of("2026-03-01 13:00", TimeZone("Europe/Berlin")), kNoon_us);
  EXPECT_EQ(time_of("2026-03-01 12:00Z", TimeZone("Europe/Berlin")), kNoon_us);
  EXPECT_EQ(time_of("2026-03-01", TimeZone("Asia/Kolkata")), time_of("2026-02-28T18:30:00Z"));
}

TEST(ReadTime, AnHourThatTheClockLeavesOut) {
  const TimeProblem problem = problem_of("2026-03-29T02:30", TimeZone("Europe/Berlin"));
  EXPECT_EQ(problem.what,
            "is not a time in Europe/Berlin: the clock was put forward from 02:00 CET to 03:00 "
            "CEST then");
  EXPECT_EQ(problem.hint,
            "write the time that the clock showed, with its offset: 2026-03-29T03:30:00+02:00");
}

TEST(ReadTime, AnHourThatTheClockRepeats) {
  const TimeProblem problem = problem_of("2026-10-25T02:30", TimeZone("Europe/Berlin"));
  EXPECT_EQ(problem.what,
            "is two times in Europe/Berlin: the clock was put back from 03:00 CEST to 02:00 CET "
            "then");
  EXPECT_EQ(problem.hint,
            "write the offset: 2026-10-25T02:30:00+02:00 (CEST) or 2026-10-25T02:30:00+01:00 "
            "(CET)");
}

TEST(ReadTime, ADayBeginsOnceAlsoWhereTheClockIsChangedAtMidnight) {
  // Cairo's clock goes from 00:00 to 01:00, and on another day from 24:00 back to 23:00.
  const TimeZone cairo("Africa/Cairo");
  EXPECT_EQ(format_time(time_of("2026-04-24", cairo), cairo), "2026-04-24T01:00:00+03:00");
  // Havana's from 01:00 back to 00:00: the first of the two midnights.
  const TimeZone havana("America/Havana");
  EXPECT_EQ(format_time(time_of("2026-11-01", havana), havana), "2026-11-01T00:00:00-04:00");
}

TEST(TimeOption, NamesOptionAndRemedy) {
  EXPECT_EQ(time_option("--since", "2026-03-01T12:00", {}), kNoon_us);
  try {
    (void)time_option("--since", "soon", {});
    FAIL() << "accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::usage);
    EXPECT_STREQ(failure.what(), "--since \"soon\" is not a time");
    EXPECT_EQ(failure.hint(), "write ISO 8601 in the years 1 to 9999, e.g. 2026-03-01T12:00:00Z");
  }
}

}  // namespace
}  // namespace loopscope::daemon
