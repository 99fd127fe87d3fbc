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
  EXPECT_EQ(time_zone_hint("Eurpoe/Berlin"), "did you mean \"Europe/Berlin\"?");
  EXPECT_EQ(time_zone_hint("America/Berlin"), "did you mean \"Europe/Berlin\"?");
  EXPECT_EQ(time_zone_hint("America/Argentina/Slata"), "did you mean \"America/Argentina/Salta\"?");
}

TEST(TimeZones, AnotherCityIsNoMisspelling) {
  for (const char* name : {"Europe/Bonn", "Europe/Munich", "Mars/Olympus", "at the seaside"}) {
    EXPECT_EQ(time_zone_hint(name),
              "write a name of the IANA database, region and a large city of the zone, e.g. "
              "\"Europe/Berlin\"; `timedatectl list-timezones` lists them")
        << name;
  }
}

}  // namespace
}  // namespace loopscope::config::tests
