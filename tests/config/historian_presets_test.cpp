#include "config/historian_presets.hpp"

#include <gmock/gmock.h>
#include <stdexcept>

#include "config/historian_rules.hpp"
#include "config/problem_list.hpp"
#include "config/read_settings.hpp"
#include "tests/config/settings_text.hpp"

namespace loopscope::config::tests {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(HistorianPresets, AreSoundButForWhatASiteHasToSay) {
  for (const std::string_view name : preset_names()) {
    HistorianSettings historian = historian_preset(name);
    EXPECT_EQ(historian.preset, name);
    if (historian.layout != "wide" && historian.tag_column.empty()) historian.tag_column = "loop";
    ProblemList problems;
    check_historian(historian, "/historians/0", problems);
    EXPECT_TRUE(problems.problems().empty()) << name << ": " << problems.problems()[0].message;
  }
  EXPECT_THROW(static_cast<void>(historian_preset("pi")), std::invalid_argument);
}

std::string text_with(const std::string& historian) {
  return R"({"results": {"connection": "service=r"}, "historians": [)" + historian + "]}";
}

TEST(HistorianPresets, OtherKeysChangeThePresetWhereverItStands) {
  const Settings settings = parse_settings(
      text_with(
          R"({"table": "public.mine", "more_value_columns": ["a", "b"], "connection": "service=h",
          "preset": "ignition"})"),
      "test.json");
  const HistorianSettings& historian = settings.historians[0];
  EXPECT_EQ(historian.table, "public.mine");
  EXPECT_THAT(historian.more_value_columns, ElementsAre("a", "b"));
  EXPECT_EQ(historian.tag_table, "public.sqlth_te");
}

/// Every problem with its hint, a line each.
std::string complaints(const std::string& historian) {
  std::string text;
  for (const Problem& problem : problems_of(text_with(historian)))
    text += problem.path + ": " + problem.message + " HINT: " + problem.hint + "\n";
  return text;
}

TEST(HistorianPresets, HalfAMappingIsRefused) {
  EXPECT_THAT(complaints(R"({"connection": "service=h", "preset": "telegraf"})"),
              testing::AllOf(HasSubstr("/historians/0/table: is missing"),
                             HasSubstr("/historians/0/tag_column: is missing")));
  EXPECT_THAT(complaints(R"({"connection": "service=h", "preset": "ignitoin"})"),
              HasSubstr("did you mean \"ignition\"?"));
  EXPECT_THAT(complaints(R"({"connection": "service=h", "time_kind": "timestamp_local"})"),
              HasSubstr("/historians/0/time_zone: is missing: local times say nothing"));
  EXPECT_THAT(complaints(R"({"connection": "service=h", "tag_table": "tags"})"),
              HasSubstr("/historians/0/tag_id_column: is missing, `tag_table` needs it"));
  EXPECT_THAT(complaints(R"({"connection": "service=h", "quality_rule": "codes"})"),
              HasSubstr("/historians/0/good_codes: is empty"));
  EXPECT_THAT(complaints(R"({"connection": "service=h", "manual_codes": ["0", "MAN"]})"),
              HasSubstr("/historians/0/manual_codes/1: \"MAN\" is not a number"));
  EXPECT_THAT(complaints(R"({"connection": "service=h", "states": ["ON"]})"),
              HasSubstr("is not TEXT=NUMBER"));
  EXPECT_THAT(complaints(R"({"connection": "service=h", "good_codes": "1"})"),
              HasSubstr("put it into brackets"));
}

}  // namespace
}  // namespace loopscope::config::tests
