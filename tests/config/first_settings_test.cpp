#include "config/first_settings.hpp"

#include <gmock/gmock.h>

#include "config/historian_presets.hpp"
#include "config/read_settings.hpp"

namespace loopscope::config::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

HistorianSettings site_of(std::string_view preset) {
  HistorianSettings historian = historian_preset(preset);
  historian.name = "plant";
  historian.connection = R"(host=db2 user="odd" dbname='a\'b')";
  if (historian.table.empty()) historian.table = "public.\"t";
  if (historian.layout != "wide" && historian.tag_column.empty()) historian.tag_column = "loop";
  return historian;
}

TEST(FirstSettings, AreReadAsTheyWereMeant) {
  for (const std::string_view preset : preset_names()) {
    const HistorianSettings historian = site_of(preset);
    const Settings read = parse_settings(
        first_settings_text(
            {"service=w", "service=o", "service=e", historian, {"look\n\"here\" */"}}),
        "x");
    EXPECT_EQ(read.historians.at(0), historian) << preset;
    EXPECT_EQ(read.results.connection, "service=w");
    EXPECT_EQ(read.results.owner_connection, "service=o");
  }
}

TEST(FirstSettings, NameWhatDiffersFromThePresetAndNoMore) {
  HistorianSettings historian = site_of("narrow");
  historian.quality_rule = "codes";
  historian.good_codes = {"1"};
  const std::string text =
      first_settings_text({"service=w", "service=o", "service=e", historian, {"a note"}});
  EXPECT_THAT(text, AllOf(HasSubstr("      // a note\n      \"name\": \"plant\",\n"),
                          HasSubstr("\"quality_rule\": \"codes\",\n      \"good_codes\": [\"1\"]"),
                          Not(HasSubstr("time_column")), Not(HasSubstr("tag_column"))));
}

/// As somebody uncomments what is offered.
TEST(FirstSettings, WhatIsOfferedCanBeUncommented) {
  std::string text =
      first_settings_text({"service=w", "service=o", "service=e", site_of("narrow"), {}});
  for (const std::string offered : {"// \"engineer_connection\"", "// \"plant\""}) {
    const std::size_t at = text.find(offered);
    ASSERT_NE(at, std::string::npos) << offered;
    text.erase(at, 3);
  }
  const Settings read = parse_settings(text, "x");
  EXPECT_EQ(read.plant.time_zone, "Europe/Berlin");
  EXPECT_EQ(read.results.engineer_connection, "service=e");
}

}  // namespace
}  // namespace loopscope::config::tests
