#include "daemon/output/annotation_text.hpp"

#include <gmock/gmock.h>

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kNewYear = 1'767'225'600'000'000;  // 2026-01-01

TEST(AnnotationText, ALineSaysWhatHoldsAndUntilWhen) {
  EXPECT_EQ(annotation_line({"FIC101", "suppressed", std::nullopt, kNewYear, "", "", 0}, {}),
            "suppressed FIC101, whatever the verdict, until 2026-01-01T00:00:00Z");
  EXPECT_EQ(
      annotation_line({"FIC101", "acknowledged", "valve_stiction", std::nullopt, "", "", 0}, {}),
      "acknowledged FIC101, verdict valve_stiction, until work done since is entered "
      "(loopscope maintenance) and a window lies wholly after it, or until it is withdrawn");
  EXPECT_EQ(
      annotation_line({"FIC101", "false_positive", std::nullopt, std::nullopt, "", "", 0}, {}),
      "false_positive FIC101, whatever the verdict, until it is withdrawn");
}

TEST(AnnotationText, ATableOfWhatHolds) {
  EXPECT_EQ(annotation_table({}, {}), "no annotation holds\n");
  const std::string table = annotation_table(
      {{"FIC101", "suppressed", std::nullopt, kNewYear, "shutdown", "anna", kNewYear + 500'000},
       {"FIC102", "acknowledged", "valve_stiction", std::nullopt, "", "ls_engineer", kNewYear,
        "J. Doe"}},
      {});
  EXPECT_EQ(table,
            "loop                     what           verdict                until                "
            "by                           since                reason\n"
            "FIC101                   suppressed     any                    2026-01-01T00:00:00Z "
            "anna                         2026-01-01T00:00:00Z shutdown\n"
            "FIC102                   acknowledged   valve_stiction         work is entered      "
            "J. Doe (login ls_engineer)   2026-01-01T00:00:00Z \n");
}

TEST(AnnotationText, TimesAreThoseOfThePlant) {
  const TimeZone kolkata("Asia/Kolkata");
  EXPECT_EQ(annotation_line({"FIC101", "suppressed", std::nullopt, kNewYear, "", "", 0}, kolkata),
            "suppressed FIC101, whatever the verdict, until 2026-01-01T05:30:00+05:30");
  EXPECT_EQ(
      annotation_table(
          {{"FIC101", "suppressed", std::nullopt, kNewYear, "shutdown", "anna", kNewYear}},
          kolkata),
      "loop                     what           verdict                until                     "
      "by                           since                     reason\n"
      "FIC101                   suppressed     any                    2026-01-01T05:30:00+05:30 "
      "anna                         2026-01-01T05:30:00+05:30 shutdown\n");
}

TEST(AnnotationText, WhatElseHoldsIsToldWithItsAuthor) {
  EXPECT_EQ(others_in_force({}, {}), "");
  EXPECT_EQ(
      others_in_force({{{"FIC101", "acknowledged", "valve_stiction", std::nullopt, "ordered",
                         "ls_engineer", kNewYear, "J. Doe"}},
                       {{"FIC101", "suppressed", std::nullopt, kNewYear, "", "anna", kNewYear}}},
                      {}),
      "  takes the place of what was in force already: acknowledged by J. Doe (login "
      "ls_engineer) since 2026-01-01T00:00:00Z, verdict valve_stiction: ordered\n"
      "  stands beside what is in force already: suppressed by anna since "
      "2026-01-01T00:00:00Z, whatever the verdict, until 2026-01-01T00:00:00Z\n"
      "  `withdraw` takes back all that holds of the loop, with --code one verdict's\n");
}

TEST(AnnotationText, WordsSteerNoTerminal) {
  const std::string table = annotation_table(
      {{"a\nb", "acknowledged", "x\x1b", std::nullopt, "y\x1b[2J", "z\r", kNewYear, "w\n"}}, {});
  for (const char* word : {"a\\x0ab", "x\\x1b", "y\\x1b[2J", "w\\x0a (login z\\x0d)"})
    EXPECT_THAT(table, HasSubstr(word));
}

}  // namespace
}  // namespace loopscope::daemon
