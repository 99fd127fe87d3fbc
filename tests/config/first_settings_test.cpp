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
        first_settings_text({"service=w", "service=o", historian, {"look\n\"here\" */"}}), "x");
    EXPECT_EQ(read.historians.at(0), historian) << preset;
    EXPECT_EQ(read.results.connection, "service=w");
    EXPECT_EQ(read.results.owner_connection, "service=o");
  }
}

TEST(FirstSettings, NameWhatDiffersFromThePresetAndNoMore) {
  HistorianSettings historian = site_of("narrow");
  historian.quality_rule = "codes";
  historian.good_codes = {"1"};
  const std::string text = first_settings_text({"service=w", "service=o", historian, {"a note"}});
  EXPECT_THAT(text, AllOf(HasSubstr("      // a note\n      \"name\": \"plant\",\n"),
                          HasSubstr("\"quality_rule\": \"codes\",\n      \"good_codes\": [\"1\"]"),
                          Not(HasSubstr("time_column")), Not(HasSubstr("tag_column"))));
}

}  // namespace
}  // namespace loopscope::config::tests
