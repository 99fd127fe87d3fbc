#include "daemon/report/figures/time_axis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/times.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(TimeAxis, NamesDayAndZoneAndCountsInRoundTimes) {
  EXPECT_EQ(time_axis(kNoon_us, kNoon_us + 2 * kHour_us, {}),
            "set xrange [1772366400.000:1772373600.000]\n"
            "set xtics offset 0,0.4 ('12:00' 1772366400, '12:30' 1772368200, '13:00' 1772370000, "
            "'13:30' 1772371800, '14:00' 1772373600)\n"
            "set xlabel 'time (UTC) on 2026-03-01' offset 0,0.6\n");
  const std::string weeks = time_axis(kNoon_us, kNoon_us + 500 * kHour_us, {});
  EXPECT_THAT(weeks, HasSubstr("time (UTC), 2026-03-01 to 2026-03-22"));
  EXPECT_THAT(weeks, HasSubstr("('05 Mar' 1772668800, '12 Mar' 1773273600, '19 Mar' 1773878400)"));
  EXPECT_THAT(time_axis(kNoon_us, kNoon_us + kHour_us / 200, {}), HasSubstr("'12:00:05'"));
}

TEST(TimeAxis, ASilentOneHasTheSameTicsAndNoWords) {
  EXPECT_EQ(silent_time_axis(kNoon_us, kNoon_us + kHour_us, {}),
            "set xrange [1772366400.000:1772370000.000]\n"
            "set xtics offset 0,0.4 ('' 1772366400, '' 1772367000, '' 1772367600, '' 1772368200, "
            "'' 1772368800, '' 1772369400, '' 1772370000)\nunset xlabel\n");
}

TEST(TimeAxis, TicsAreRoundOnTheClockOfThePlant) {
  EXPECT_EQ(time_axis(kNoon_us, kNoon_us + 4 * kHour_us, TimeZone("Asia/Kolkata")),
            "set xrange [1772366400.000:1772380800.000]\n"
            "set xtics offset 0,0.4 ('18:00' 1772368200, '19:00' 1772371800, '20:00' 1772375400, "
            "'21:00' 1772379000)\n"
            "set xlabel 'time (IST) on 2026-03-01' offset 0,0.6\n");
}

TEST(TimeAxis, WhereTheClockIsPutForwardAnHourIsLeftOut) {
  EXPECT_EQ(time_axis(kBerlinForward_us - 2 * kHour_us, kBerlinForward_us + 2 * kHour_us,
                      TimeZone("Europe/Berlin")),
            "set rmargin at screen 0.9\n"
            "set xrange [1774738800.000:1774753200.000]\n"
            "set xtics offset 0,0.4 ('00:00 CET' 1774738800, '01:00 CET' 1774742400, '03:00 CEST' "
            "1774746000, '04:00 CEST' 1774749600, '05:00 CEST' 1774753200)\n"
            "set xlabel 'time (CET, then CEST) on 2026-03-29' offset 0,0.6\n");
}

TEST(TimeAxis, WhereTheClockIsPutBackAnHourStandsTwice) {
  EXPECT_EQ(time_axis(kBerlinBack_us - 2 * kHour_us, kBerlinBack_us + 2 * kHour_us,
                      TimeZone("Europe/Berlin")),
            "set rmargin at screen 0.9\n"
            "set xrange [1792882800.000:1792897200.000]\n"
            "set xtics offset 0,0.4 ('01:00 CEST' 1792882800, '02:00 CEST' 1792886400, '02:00 CET' "
            "1792890000, '03:00 CET' 1792893600, '04:00 CET' 1792897200)\n"
            "set xlabel 'time (CEST, then CET) on 2026-10-25' offset 0,0.6\n");
}

TEST(TimeAxis, DaysOverAChangeBeginAtMidnightOfThePlant) {
  const std::string week = time_axis(kBerlinBack_us - 3 * 24 * kHour_us,
                                     kBerlinBack_us + 2 * 24 * kHour_us, TimeZone("Europe/Berlin"));
  EXPECT_THAT(week, Not(HasSubstr("rmargin")));
  // 25 h lie between the two midnights.
  EXPECT_THAT(week, HasSubstr("'25 Oct' 1792879200, '26 Oct' 1792969200"));
  EXPECT_THAT(week, HasSubstr("time (CEST, then CET), 2026-10-22 to 2026-10-27"));
  const std::string year =
      time_axis(kBerlinForward_us - kHour_us, kBerlinBack_us + kHour_us, TimeZone("Europe/Berlin"));
  EXPECT_THAT(year, HasSubstr("time (CET and CEST), 2026-03-29 to 2026-10-25"));
  EXPECT_THAT(year, Not(HasSubstr("CEST'")));
}

TEST(TimeAxis, OfALoneMomentTheListIsNotEmpty) {
  EXPECT_THAT(time_axis(kNoon_us + 1, kNoon_us + 1, {}), Not(HasSubstr("()")));
}

}  // namespace
}  // namespace loopscope::daemon
