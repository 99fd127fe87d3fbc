#include "daemon/report/annotate/entry_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

constexpr std::int64_t kNewYear = 1'767'225'600'000'000;  // 2026-01-01T00:00:00Z

TEST(EntryText, SentencesAreThoseOfAPage) {
  const TimeZone berlin("Europe/Berlin");
  EXPECT_EQ(entered_sentence({"FIC101", "suppressed", std::nullopt, kNewYear, "", "", 0}, berlin),
            "Entered: suppressed, whatever the verdict, until 2026-01-01 01:00 CET.");
  EXPECT_EQ(
      entered_sentence({"FIC101", "acknowledged", "valve_stiction", std::nullopt, "", "", 0}, {}),
      "Entered: acknowledged, verdict valve stiction, until work is entered.");
  EXPECT_THAT(
      others_told(
          {{{"FIC101", "acknowledged", "valve_stiction", std::nullopt, "ordered", "ls_engineer",
             kNewYear, "J. Doe"}},
           {{"FIC101", "false_positive", std::nullopt, std::nullopt, "", "anna", kNewYear}}},
          berlin),
      testing::ElementsAre(
          "Takes the place of what was in force already: acknowledged by J. Doe (login "
          "ls_engineer) since 2026-01-01 01:00 CET, verdict valve stiction, until work is entered: "
          "ordered",
          "Stands beside what is in force already: false positive by anna since 2026-01-01 01:00 "
          "CET, whatever the verdict, until withdrawn."));
}

}  // namespace
}  // namespace loopscope::daemon
