#include "config/time_zones.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace loopscope::config::tests {
namespace {

TEST(TimeZones, NamesAreThoseOfTheSystemsDatabase) {
  EXPECT_GT(time_zone_names().size(), 400U);
  EXPECT_TRUE(std::ranges::is_sorted(time_zone_names()));
  for (const char* name : {"UTC", "Europe/Berlin", "Asia/Calcutta", "America/Argentina/Salta"})
    EXPECT_TRUE(is_time_zone(name)) << name;
  for (const char* name : {"", "localtime", "europe/berlin", "Berlin", "../etc/passwd", "CEST"})
    EXPECT_FALSE(is_time_zone(name)) << name;
}

TEST(TimeZones, HintsNameTheNearest) {
  EXPECT_EQ(time_zone_hint("Europe/Berln"), "did you mean \"Europe/Berlin\"?");
  EXPECT_EQ(time_zone_hint("europe/berlin"), "did you mean \"Europe/Berlin\"?");
  EXPECT_EQ(time_zone_hint("berlin"), "did you mean \"Europe/Berlin\"?");
  EXPECT_EQ(time_zone_hint("utc"), "did you mean \"UTC\"?");
  EXPECT_EQ(time_zone_hint("CEST"), "did you mean \"CET\"?");
  EXPECT_EQ(time_zone_hint("at the seaside"),
            "write a name of the IANA database, e.g. \"Europe/Berlin\"; `timedatectl "
            "list-timezones` lists them");
}

}  // namespace
}  // namespace loopscope::config::tests
