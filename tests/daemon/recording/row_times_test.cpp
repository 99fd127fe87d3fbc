#include "daemon/recording/row_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <initializer_list>

#include "tests/daemon/data_failure.hpp"
#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::int64_t> times_of(const std::string& column,
                                   std::initializer_list<const char*> cells,
                                   const TimeZone& zone = {}) {
  std::string text = column + ",pv\n";
  for (const char* cell : cells) text += std::string(cell) + ",1\n";
  const CsvTable table = parse_csv(text, "f.csv");
  return read_times(table, find_columns(table), {}, zone);
}

Failure times_failure(const std::string& column, std::initializer_list<const char*> cells,
                      const TimeZone& zone = {}) {
  return data_failure([&] { return times_of(column, cells, zone); });
}

TEST(RowTimes, SecondsAndIsoTimesAsMicroseconds) {
  EXPECT_THAT(times_of("t_s", {"-1.5", "0", "0", "2e-6"}), ElementsAre(-1'500'000, 0, 0, 2));
  EXPECT_THAT(times_of("time", {"1970-01-01T00:00:01Z", "1970-01-01T01:00:02+01:00"}),
              ElementsAre(1'000'000, 2'000'000));
}

TEST(RowTimes, DatesWithPointsBeginWithTheDay) {
  EXPECT_THAT(times_of("time", {"01.02.1970 00:00:01", "1.2.1970 0:01", "1970/02/02"}),
              ElementsAre(2'678'401'000'000, 2'678'460'000'000, 2'764'800'000'000));
}

TEST(RowTimes, OtherDatesHaveToBeSaid) {
  const Failure failure = times_failure("time", {"01/02/1970 00:00:01"});
  EXPECT_STREQ(failure.what(),
               "f.csv, line 2, column \"time\": of the date \"01/02/1970 00:00:01\" day and month "
               "cannot be told apart");
  EXPECT_EQ(failure.hint(),
            "say which comes first: --date-order dmy, or mdy as in the United States");
  const auto times = [](DateOrder order) {
    const CsvTable table = parse_csv("time,pv\n01/02/1970,1\n", "f.csv");
    return read_times(table, find_columns(table), {'.', order}).front() / 86'400'000'000;
  };
  EXPECT_EQ(times(DateOrder::day_first), 31);
  EXPECT_EQ(times(DateOrder::month_first), 1);
}

TEST(RowTimes, SecondsInATimeColumnAreNamed) {
  EXPECT_EQ(times_failure("time", {"12.5"}).hint(),
            "write ISO 8601 in the years 1 to 9999, e.g. 2026-03-01T12:00:00Z; where the column "
            "counts seconds: --columns t_s=NAME");
}

TEST(RowTimes, CellsThatAreNoTime) {
  for (const char* cell : {"", "nan", "inf", "1e300", "9.1e12", "-9.1e12", "noon"}) {
    const Failure failure = times_failure("t_s", {"0", cell});
    EXPECT_EQ(failure.what(),
              "f.csv, line 3, column \"t_s\": \"" + std::string(cell) + "\" is not a time");
    EXPECT_EQ(failure.hint(), "every row needs its time in seconds, within +-9e12");
  }
  for (const char* cell : {"yesterday", "10000-01-01T00:00:00Z", "0000-01-01T00:00:00Z"}) {
    const Failure failure = times_failure("time", {cell});
    EXPECT_EQ(failure.what(),
              "f.csv, line 2, column \"time\": \"" + std::string(cell) + "\" is not a time");
    EXPECT_EQ(failure.hint(), "write ISO 8601 in the years 1 to 9999, e.g. 2026-03-01T12:00:00Z");
  }
}

TEST(RowTimes, BackwardsInLocalTimeIsBlamedOnDaylightSaving) {
  const Failure local = times_failure("time", {"2026-10-25 02:59:00", "2026-10-25 02:00:00"});
  EXPECT_STREQ(local.what(),
               "f.csv, line 3, column \"time\": the time \"2026-10-25 02:00:00\" runs backwards");
  EXPECT_EQ(local.hint(),
            "write the times in UTC or with their offset, or name their zone (/plant/time_zone, or "
            "--time-zone of analyze); local time repeats an hour when daylight saving ends");
}

TEST(RowTimes, LocalTimesGoOnThroughTheHourThatIsRepeated) {
  const TimeZone berlin("Europe/Berlin");
  EXPECT_THAT(
      times_of("time",
               {"2026-10-25 02:58", "2026-10-25 02:59", "2026-10-25 02:00", "2026-10-25 02:01",
                "2026-10-25 03:00"},
               berlin),
      ElementsAre(kBerlinBack_us - 2 * kMinute_us, kBerlinBack_us - kMinute_us, kBerlinBack_us,
                  kBerlinBack_us + kMinute_us, kBerlinBack_us + 60 * kMinute_us));
  // Two passes are all that there are.
  EXPECT_EQ(
      times_failure("time", {"2026-10-25 02:59", "2026-10-25 02:00", "2026-10-25 01:00"}, berlin)
          .hint(),
      "sort the rows by time");
}

TEST(RowTimes, ATimeThatTheClockHasLeftOutIsRefused) {
  const Failure failure = times_failure("time", {"2026-03-29 02:30"}, TimeZone("Europe/Berlin"));
  EXPECT_STREQ(failure.what(),
               "f.csv, line 2, column \"time\": \"2026-03-29 02:30\" is not a time in "
               "Europe/Berlin: the clock was put forward from 02:00 CET to 03:00 CEST then");
  EXPECT_EQ(failure.hint(),
            "write the time that the clock showed, with its offset: 2026-03-29T03:30:00+02:00");
}

TEST(RowTimes, BackwardsElsewhereNeedsSorting) {
  EXPECT_EQ(times_failure("t_s", {"5", "4"}).hint(), "sort the rows by time");
  EXPECT_THAT(times_failure("time", {"2026-10-25T02:59:00Z", "2026-10-25T02:00:00Z"}).hint(),
              HasSubstr("sort the rows"));
  EXPECT_THAT(
      times_failure("time", {"2026-10-25T02:59:00+01:00", "2026-10-25T02:00:00+01:00"}).hint(),
      HasSubstr("sort the rows"));
}

TEST(RowTimes, TheSpanEndsBeforeATimeThatCannotBelongToIt) {
  EXPECT_EQ(times_of("t_s", {"8999999999999", "9e12"}).size(), 2U);
  EXPECT_EQ(times_of("t_s", {"-1.5e10", "1.5e10"}).size(), 2U);
  const Failure seconds = times_failure("t_s", {"-9e12", "9e12"});
  EXPECT_STREQ(seconds.what(),
               "f.csv, line 3, column \"t_s\": the time \"9e12\" lies more than 3e10 s (950 years) "
               "after the first");
  EXPECT_EQ(seconds.hint(), "check the times: t_s counts seconds");
  EXPECT_THAT(times_failure("t_s", {"0", "1", "30000000001"}).what(), HasSubstr("line 4"));
  EXPECT_EQ(times_failure("time", {"0001-01-01", "2026-01-01"}).hint(),
            "check the years of the times");
}

}  // namespace
}  // namespace loopscope::daemon
