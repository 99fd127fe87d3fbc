#include "storage/startup_options.hpp"

#include <gmock/gmock.h>

namespace loopscope::storage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

TEST(StartupOptions, SettingsAreTakenInEveryForm) {
  const StartupOptions split = split_startup_options(
      R"(-c jit=off  -cwork_mem=64MB --lock-timeout=1s -c TimeZone=A -c timezone=B)"
      R"( -c search_path=a\ b\\c -c my.name=x=y)");
  EXPECT_THAT(split.settings, ElementsAre(Pair("jit", "off"), Pair("lock_timeout", "1s"),
                                          Pair("my.name", "x=y"), Pair("search_path", R"(a b\c)"),
                                          Pair("timezone", "B"), Pair("work_mem", "64MB")));
  EXPECT_EQ(split.rest, "");
}

TEST(StartupOptions, WhateverElseStandsThereStays) {
  const StartupOptions split =
      split_startup_options(R"(endpoint=db-1 -S 64 -c jit=off a\ b\\ --sort -c)");
  EXPECT_THAT(split.settings, ElementsAre(Pair("jit", "off")));
  EXPECT_EQ(split.rest, R"(endpoint=db-1 -S 64 a\ b\\ --sort -c)");
  EXPECT_THAT(split_startup_options("  ").settings, IsEmpty());
  EXPECT_EQ(split_startup_options("  ").rest, "");
}

}  // namespace
}  // namespace loopscope::storage
